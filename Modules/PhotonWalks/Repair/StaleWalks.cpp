// SPDX-License-Identifier: BSD-3-Clause
#include "Repair/StaleWalks.h"

#include "Sampling/ElementaryFunctions.h"

#include <functional>
#include <map>

namespace irradiance
{

namespace
{

/// The class of a power, four classes to an octave: sign, exponent and two bits, 11 in all.
std::uint32_t powerClassOf(const Power& power)
{
  const auto all = static_cast<float>(power[0] + power[1] + power[2]);
  return bitCast<std::uint32_t>(all) >> 21;
}

/// Of any triangle, in all.
double largestReflectance(const SceneObjects& objects)
{
  double all = 0;
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    const Material& material = *objects[object].material;
    for (const std::uint32_t cell : material.cellOfTriangle)
    {
      // More than 1 in all if they are of different bands: then powers may grow. A pane sends most
      // on at grazing incidence.
      double sum = 0;
      for (const Bands& part : material.partsOf(cell, 0))
      {
        sum += part.largest();
      }
      all = std::max(all, sum);
    }
  }
  return all;
}

}

StaleWalks::StaleWalks(
  const SceneObjects& objects, std::size_t blocks, const SobolSequence& samples)
  : blocks_(blocks)
  , sums_(objects)
  , samples_(samples)
  , reflectance_(largestReflectance(objects))
{
}

void StaleWalks::repaint(const SceneObjects& objects, const WalkHistory& history)
{
  reflectance_ = largestReflectance(objects);
  for (Block& block : blocks_)
  {
    block.power = {};
    for (StaleMark& mark : block.marks)
    {
      const Power carried = history.power(mark.first());
      mark.gain = gainOf(mark.walk, mark.bounce, carried);
      block.power.add(carried, mark.gain, 1);
    }
  }
}

std::vector<std::pair<std::uint16_t, std::size_t>> StaleWalks::classes(std::size_t enough) const
{
  std::map<std::uint16_t, std::size_t, std::greater<>> counts;
  for (const Block& block : blocks_)
  {
    for (const StaleMark& mark : block.marks)
    {
      ++counts[mark.powerClass];
    }
  }
  std::vector<std::pair<std::uint16_t, std::size_t>> classes;
  for (const auto& [powerClass, count] : counts)
  {
    if (classes.empty() || classes.back().second >= enough)
    {
      classes.emplace_back(powerClass, 0);
    }
    classes.back().first = powerClass;
    classes.back().second += count;
  }
  return classes;
}

void StaleWalks::add(
  std::size_t block, const WalkHistory& history, const std::vector<SegmentRef>& found)
{
  const StaleMarks before = std::move(blocks_[block].marks);
  StaleMarks& marks = blocks_[block].marks;
  marks.clear();
  marks.reserve(before.size() + found.size());
  std::vector<Deposit> deposits;
  auto old = before.begin();
  for (const SegmentRef& first : found)
  {
    for (; old != before.end() && old->walk < first.walk; ++old)
    {
      marks.push_back(*old);
    }
    std::uint32_t end = kAll;
    if (old != before.end() && old->walk == first.walk)
    {
      blocks_[block].power.add(history.power(old->first()), old->gain, -1);
      end = old->bounce; // the rest has been tallied
      ++old;
    }
    const Power carried = history.power(first);
    marks.push_back({ first.walk, first.bounce & 0x1fffffu, powerClassOf(carried) & 0x7ffu,
      gainOf(first.walk, first.bounce, carried) });
    blocks_[block].power.add(carried, marks.back().gain, 1);
    tally(history, marks.back(), end, 1, deposits);
  }
  marks.insert(marks.end(), old, before.end());
  sums_.add(deposits);
}

void StaleWalks::forget(const WalkHistory& history, std::uint32_t walk)
{
  const std::size_t block = history.indexOf(walk);
  for (StaleMark& mark : blocks_[block].marks)
  {
    if (mark.walk == walk)
    {
      std::vector<Deposit> deposits;
      repair(history, mark, deposits);
      take(deposits);
    }
  }
  forgetRepaired(block);
}

void StaleWalks::tally(const WalkHistory& history, const StaleMark& mark, std::uint32_t end,
  int sign, std::vector<Deposit>& deposits) const
{
  const SegmentPlace first = history.placeOf(mark.first());
  const BounceBlock& block = history.block(first.block);
  std::uint32_t bounce = mark.bounce;
  for (std::uint32_t slot = first.slot; slot != BounceBlock::kNone && bounce < end; ++bounce)
  {
    if (const std::uint32_t triangle = block.triangle(slot); triangle != BounceBlock::kNone)
    {
      const SceneCell cell = sums_.cellOf(history.numbers().idOf(triangle));
      sums_.collect(
        sums_.slotOf(mark.walk, cell), block.isFront(slot), block.power(slot), sign, deposits);
    }
    slot = block.next(slot);
  }
}

}
