// SPDX-License-Identifier: BSD-3-Clause
#include "DirectLight/DirectLight.h"

#include "Surfaces/ClearSheets.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace irradiance
{

namespace
{

/// Cells gather together until they have more samples than this.
constexpr std::uint32_t kSamplesOfCells = 8192;

/// Samples that are looked at together after a motion.
constexpr std::uint32_t kSamplesTogether = 8192;

/// Whether a sample's way to its light may touch a box. Roundings are far below the widths of
/// boxes.
bool mayTouch(const DirectSample& sample, const Box& box)
{
  const Vector3 along = sample.to - sample.from;
  double first = 0, last = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double inverse = 1 / along[axis]; // infinite: both ends are inside, or none
    double enter = (box.lower[axis] - sample.from[axis]) * inverse;
    double leave = (box.upper[axis] - sample.from[axis]) * inverse;
    if (enter > leave)
    {
      std::swap(enter, leave);
    }
    // What is not a number, on a face of the box, cuts nothing off.
    first = enter > first ? enter : first;
    last = leave < last ? leave : last;
  }
  return first <= last;
}

/// Where what moved is now, with what rounding calls for.
std::vector<Box> movedBoxes(const Frame& frame)
{
  std::vector<Box> boxes;
  for (std::uint32_t i = 0; i < frame.moved.size(); ++i)
  {
    Box box = frame.objects.dynamicObjects[i].worldBounds();
    if (frame.moved[i] && !box.isEmpty())
    {
      box.inflate(frame.scene.shadowPad(i, frame.scene.clearance()));
      boxes.push_back(box);
    }
  }
  return boxes;
}

bool hasSheets(const SceneObject& object)
{
  return object.isPresent && object.material->hasSheets();
}

bool haveSheetsMoved(const Frame& frame)
{
  for (std::uint32_t i = 0; i < frame.moved.size(); ++i)
  {
    if (frame.moved[i] && frame.objects.dynamicObjects[i].material->hasSheets())
    {
      return true;
    }
  }
  return false;
}

}

DirectLight::DirectLight(const CellShapes& cells, const LampPieces& lamps, const DirectPlan& plan,
  std::uint64_t seed, double quantaPerWatt)
  : cells_(cells)
  , lamps_(lamps)
  , plan_(plan)
  , seed_(seed)
  , quantaPerWatt_(quantaPerWatt)
{
}

void DirectLight::gather(const Frame& frame, Execution& execution)
{
  const CancelPoint cancelPoint = cancelPointOf(execution, 0);
  samples_.resize(plan_.size()); // all are made below
  assignPaced(views_, plan_.size(), kNever, cancelPoint);
  makeRoom(frame);
  assignPaced(units_, cells_.size(), 0.0, cancelPoint);
  assignPaced(variances_, cells_.size(), {}, cancelPoint);
  std::vector<std::size_t> firsts{ 0 }; // cells of the units
  for (std::size_t cell = 1; cell <= cells_.size(); ++cell)
  {
    if (cell == cells_.size() || plan_.first(cell) - plan_.first(firsts.back()) >= kSamplesOfCells)
    {
      firsts.push_back(cell);
    }
  }
  forEachSliced(firsts.size() - 1, execution,
    [&](std::size_t unit) { gatherCells(frame, firsts[unit], firsts[unit + 1]); });
}

void DirectLight::gatherCells(const Frame& frame, std::size_t first, std::size_t end)
{
  CellSampler sampler(cells_, frame, lamps_, plan_, seed_);
  DirectSample* next = samples_.data() + plan_.first(first);
  for (std::size_t cell = first; cell < end; ++cell)
  {
    if (plan_.samplesOf(cell) > 0)
    {
      sampler.setCell(cell);
    }
    for (std::uint32_t i = 0; i < plan_.samplesOf(cell); ++i)
    {
      *next++ = sampler.sample(i);
    }
    units_[cell] = unitOf(cell);
  }
  std::vector<std::uint32_t> numbers(plan_.first(end) - plan_.first(first));
  std::iota(numbers.begin(), numbers.end(), plan_.first(first));
  look(frame, numbers);
  for (std::size_t cell = first; cell < end; ++cell)
  {
    variances_[cell] = varianceOf(cell);
  }
}

Bands DirectLight::varianceOf(std::size_t cell) const
{
  const std::uint32_t samples = plan_.samplesOf(cell);
  if (samples == 0)
  {
    return {};
  }
  const std::uint32_t parts = plan_.replicates() > 1 ? plan_.replicates() : samples;
  const std::uint32_t size = samples / parts;
  Bands all{}, squares{};
  for (std::uint32_t part = 0; part < parts; ++part)
  {
    const std::uint32_t first = plan_.first(cell) + part * size;
    Bands brought{};
    for (std::uint32_t i = first; i < first + size; ++i)
    {
      brought += passedTo(i) * samples_[i].part * lamps_.lights()[samples_[i].light].flux;
    }
    all += brought;
    squares += brought * brought;
  }
  Bands variance{};
  for (std::size_t band = 0; parts > 1 && band < all.size(); ++band)
  {
    variance[band] = std::max(0.0, parts * squares[band] - all[band] * all[band]) / (parts - 1);
  }
  return variance;
}

Bands DirectLight::variance() const
{
  Bands sum{};
  for (const Bands& ofCell : variances_)
  {
    sum += ofCell;
  }
  return sum;
}

void DirectLight::makeRoom(const Frame& frame)
{
  const auto& movers = frame.objects.dynamicObjects;
  if (passed_.empty() &&
    (hasSheets(frame.objects.staticObject) || std::any_of(movers.begin(), movers.end(), hasSheets)))
  {
    passed_.assign(plan_.size(), 1);
  }
}

void DirectLight::look(const Frame& frame, const std::vector<std::uint32_t>& samples)
{
  std::vector<Ray> rays;
  std::vector<std::uint32_t> numbers;
  for (const std::uint32_t number : samples)
  {
    const DirectSample& sample = samples_[number];
    if (sample.part > 0)
    {
      rays.push_back(
        { sample.from, sample.to - sample.from, lamps_.lights()[sample.light].triangle() });
      numbers.push_back(number);
    }
  }
  const Contacts& contacts = frame.contacts;
  const auto cellOf = [&](std::size_t ray) {
    return frame.triangles.idOf(samples_[numbers[ray]].triangle);
  };
  const std::vector<ClearSheets::Way> ways =
    ClearSheets{ frame.objects, frame.scene, &contacts, !passed_.empty() }.cast(
      rays.data(), rays.size(), cellOf);
  for (std::size_t ray = 0; ray < rays.size(); ++ray)
  {
    const std::uint32_t number = numbers[ray];
    const Hit& hit = ways[ray].hit;
    const TriangleId cell = cellOf(ray), lamp = rays[ray].start;
    const View free = ways[ray].meetsMovers ? kSheets : kFree;
    if (!passed_.empty())
    {
      passed_[number] = static_cast<float>(ways[ray].passed);
    }
    if (contacts.has(lamp) || contacts.has(cell))
    {
      const bool mayChange =
        hit.id.isDynamic() || contacts.hasDynamic(lamp) || contacts.hasDynamic(cell);
      views_[number] = hit.id == cell ? free : mayChange ? kTouch : kNever;
    }
    else
    {
      // What is hit beyond the end hides nothing. What a static object hides stays so.
      views_[number] = hit.distance >= 1 || hit.id == cell ? free : hit.id.object;
    }
  }
}

bool DirectLight::mayChange(
  const Frame& frame, const std::vector<Box>& boxes, bool sheetsMoved, std::uint32_t number) const
{
  const View view = views_[number];
  const DirectSample& sample = samples_[number];
  if (isFree(view))
  {
    // A contact that a motion may have made at either end decides a hit otherwise than before, also
    // far from what moved.
    return (view == kSheets && sheetsMoved) ||
      frame.contacts.hasDynamic(lamps_.lights()[sample.light].triangle()) ||
      frame.contacts.hasDynamic(frame.triangles.idOf(sample.triangle)) ||
      std::any_of(
        boxes.begin(), boxes.end(), [&](const Box& box) { return mayTouch(sample, box); });
  }
  return view == kTouch || (view != kNever && frame.moved[view - 1]);
}

std::vector<DirectLight::Change> DirectLight::follow(const Frame& frame, Execution& execution)
{
  makeRoom(frame);
  const std::vector<Box> boxes = movedBoxes(frame);
  const bool sheetsMoved = haveSheetsMoved(frame);
  const auto all = static_cast<std::uint32_t>(samples_.size());
  const std::size_t units = (all + kSamplesTogether - 1) / kSamplesTogether;
  std::vector<std::vector<Change>> changes(units);
  forEachSliced(units, execution, [&](std::size_t unit) {
    const auto first = static_cast<std::uint32_t>(unit) * kSamplesTogether;
    std::vector<std::uint32_t> suspects;
    std::vector<double> before;
    for (std::uint32_t i = first; i < std::min(first + kSamplesTogether, all); ++i)
    {
      if (mayChange(frame, boxes, sheetsMoved, i))
      {
        suspects.push_back(i);
        before.push_back(passedTo(i));
      }
    }
    look(frame, suspects);
    for (std::size_t i = 0; i < suspects.size(); ++i)
    {
      if (passedTo(suspects[i]) != before[i])
      {
        changes[unit].push_back({ suspects[i], before[i] });
      }
    }
  });
  std::vector<Change> together;
  for (const std::vector<Change>& some : changes)
  {
    together.insert(together.end(), some.begin(), some.end());
  }
  std::size_t last = plan_.numberOfCells();
  for (const Change& change : together)
  {
    const std::size_t cell = plan_.cellOf(change.sample);
    if (cell != std::exchange(last, cell))
    {
      variances_[cell] = varianceOf(cell);
    }
  }
  return together;
}

Bands DirectLight::quantaOf(const DirectSample& sample) const
{
  return quantaPerWatt_ * (sample.part * lamps_.lights()[sample.light].flux);
}

double DirectLight::unitOf(std::size_t cell) const
{
  double largest = 0;
  for (std::uint32_t i = plan_.first(cell); i < plan_.first(cell) + plan_.samplesOf(cell); ++i)
  {
    largest = std::max(largest, quantaOf(samples_[i]).largest());
  }
  return largest > 0 ? std::exp2(std::ilogb(largest * plan_.samplesOf(cell)) - 51) : 1.0;
}

Power DirectLight::add(std::uint32_t sample, double passed, std::size_t number,
  const SceneCell& cell, int sign, CellSums& sums, std::size_t round) const
{
  Bands quanta = passed * quantaOf(samples_[sample]);
  Power power;
  for (std::size_t band = 0; band < quanta.size(); ++band)
  {
    power.quanta[band] = sign * nearestQuanta(quanta[band]);
    quanta[band] = units_[number] * std::nearbyint(quanta[band] / units_[number]);
  }
  const std::uint32_t replicate = plan_.replicateOf(number, sample - plan_.first(number));
  sums.addGathered(
    sums.slotOf({ cell, 0 }, replicate, round), samples_[sample].isFront, quanta, sign);
  return power;
}

/// Other objects may have other cells than when it gathered: so cells are told by their objects.
Power DirectLight::addTo(CellSums& sums, std::size_t round, int sign, const DealtBlocks& cells,
  const CancelPoint& cancelPoint) const
{
  Power all;
  ThrottledCancelPoint pace(cancelPoint);
  std::size_t number = 0;
  cells_.numbers().forEach([&](const SceneCell& cell) {
    for (std::uint32_t i = 0; i < plan_.samplesOf(number) && cells.contains(number); ++i)
    {
      const std::uint32_t sample = plan_.first(number) + i;
      const double passed = passedTo(sample);
      all += passed > 0 ? add(sample, passed, number, cell, sign, sums, round) : Power{};
    }
    pace.step(1 + plan_.samplesOf(number));
    ++number;
  });
  return all;
}

}
