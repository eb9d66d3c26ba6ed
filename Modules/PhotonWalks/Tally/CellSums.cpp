// SPDX-License-Identifier: BSD-3-Clause
#include "Tally/CellSums.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <numeric>

namespace irradiance
{

namespace
{

/// Calls visit(first, end) for pieces of all numbers below `size`, so that no step takes long.
template <class Visit>
void forPieces(std::size_t size, const CancelPoint& cancelPoint, const Visit& visit)
{
  constexpr std::size_t kPiece = std::size_t{ 1 } << 18;
  for (std::size_t first = 0; first < size; first += kPiece)
  {
    visit(first, std::min(first + kPiece, size));
    if (cancelPoint)
    {
      cancelPoint();
    }
  }
}

/// With many replicates this is a lot of memory.
template <class Number>
void resize(std::vector<Number>& sums, std::size_t size, const CancelPoint& cancelPoint)
{
  std::vector<Number> now;
  now.reserve(size);
  forPieces(size, cancelPoint, [&](std::size_t first, std::size_t end) {
    now.insert(now.end(), sums.data() + std::min(first, sums.size()),
      sums.data() + std::min(end, sums.size()));
    now.resize(end);
  });
  sums.swap(now);
}

}

CellSums::CellSums(const SceneObjects& objects, const WalkPlan& plan, std::size_t rounds,
  const CellPart& gatherers, int sides)
  : plan_(plan)
  , sides_(sides)
  , bands_(objects.staticObject.material->bands)
  , numbers_(objects)
  , gatherers_(gatherers)
{
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    materials_.push_back(objects[object].material);
  }
  roundSize_ = numbers_.size() * slotsPerCell();
  gatheredFirst_ = slotsBefore(gatherers.first);
  gatheredSize_ = slotsBefore(gatherers.second) - gatheredFirst_;
  setRounds(rounds);
}

void CellSums::replace(const SceneObjects& objects, const std::vector<std::uint32_t>& staticCells,
  const CancelPoint& cancelPoint)
{
  CellSums now(objects, plan_, 0, gatherers_, sides_);
  now.areShot_ = areShot_;
  now.setRounds(rounds_, cancelPoint);
  ThrottledCancelPoint pace(cancelPoint);
  const auto keep = [&](const SceneCell& cell, std::size_t cellNow, std::size_t count) {
    for (std::size_t round = 0; round < rounds_; ++round)
    {
      const std::size_t first = slotOf({ cell, 0 }, 0, round);
      const std::size_t firstNow = now.slotOf({ { cell.object, cellNow }, 0 }, 0, round);
      const std::size_t size = count * slotsPerCell();
      if (areShot_)
      {
        std::copy_n(sums_.data() + first, size, now.sums_.data() + firstNow);
      }
      if (gathers(cell))
      {
        std::copy_n(gathered_.data() + gatheredPlace(first), size,
          now.gathered_.data() + now.gatheredPlace(firstNow));
      }
    }
    pace.step();
  };
  for (std::size_t cell = 0; cell < staticCells.size(); ++cell)
  {
    staticCells[cell] != TriangleId::kNone ? keep({ 0, cell }, staticCells[cell], 1) : void();
  }
  const std::size_t both = std::min<std::size_t>(objects.size(), materials_.size());
  for (std::uint32_t object = staticCells.empty() ? 0 : 1; object < both; ++object)
  {
    if (now.materials_[object]->hasCellsOf(*materials_[object]))
    {
      keep({ object, 0 }, 0, materials_[object]->numberOfCells);
    }
  }
  *this = std::move(now);
}

void CellSums::setRounds(std::size_t rounds, const CancelPoint& cancelPoint)
{
  if (rounds == rounds_)
  {
    return;
  }
  resize(sums_, areShot_ ? rounds * roundSize_ : 0, cancelPoint);
  resize(gathered_, rounds * gatheredSize_, cancelPoint);
  rounds_ = rounds;
}

void CellSums::add(const std::vector<Deposit>& deposits)
{
  // Sorted by part, each by one pass to count and one to place.
  static thread_local std::vector<Deposit> sorted;
  sorted.resize(deposits.size());
  const unsigned shift = partShift();
  std::array<std::size_t, kParts + 1> ends{};
  for (const Deposit& deposit : deposits)
  {
    ++ends[(deposit.slot >> shift) + 1];
  }
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  for (const Deposit& deposit : deposits)
  {
    sorted[ends[deposit.slot >> shift]++] = deposit;
  }
  constexpr std::size_t kAhead = 16;
  std::size_t i = 0;
  for (std::size_t part = 0; part < kParts && i < sorted.size(); ++part)
  {
    if (i == ends[part])
    {
      continue;
    }
    const std::lock_guard<std::mutex> lock((*mutexes_)[part]);
    for (; i < ends[part]; ++i)
    {
      prefetchLine(sums_.data() + sorted[std::min(i + kAhead, sorted.size() - 1)].slot);
      sums_[sorted[i].slot] += sorted[i].quanta;
    }
  }
}

void CellSums::add(const CellSums& others, const CancelPoint& cancelPoint)
{
  assert(others.sums_.size() == sums_.size());
  forPieces(sums_.size(), cancelPoint, [&](std::size_t first, std::size_t end) {
    std::transform(sums_.data() + first, sums_.data() + end, others.sums_.data() + first,
      sums_.data() + first, std::plus<>());
  });
  addGathered(others, cancelPoint);
}

void CellSums::addGathered(const CellSums& others, const CancelPoint& cancelPoint)
{
  forPieces(others.gathered_.size(), cancelPoint, [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i)
    {
      const std::size_t round = i / others.gatheredSize_, at = i - round * others.gatheredSize_;
      gathered_[round * gatheredSize_ + others.gatheredFirst_ - gatheredFirst_ + at] +=
        others.gathered_[i];
    }
  });
}

void CellSums::sumOver(Ranks& ranks, const CancelPoint& cancelPoint)
{
  forPieces(sums_.size(), cancelPoint,
    [&](std::size_t first, std::size_t end) { ranks.sum(&sums_[first], end - first); });
  // One rank alone has a number that is not 0, and the bits of 0 are 0: the sum of the bits is that
  // number.
  static_assert(sizeof(double) == sizeof(std::int64_t));
  std::vector<std::int64_t> bits;
  forPieces(gathered_.size(), cancelPoint, [&](std::size_t first, std::size_t end) {
    bits.resize(end - first);
    std::memcpy(bits.data(), &gathered_[first], bits.size() * sizeof(double));
    ranks.sum(bits.data(), bits.size());
    std::memcpy(&gathered_[first], bits.data(), bits.size() * sizeof(double));
  });
}

}
