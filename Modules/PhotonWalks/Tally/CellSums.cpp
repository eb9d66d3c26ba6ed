// SPDX-License-Identifier: BSD-3-Clause
#include "Tally/CellSums.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

namespace irradiance
{

CellSums::CellSums(const SceneObjects& objects, int sides, const WalkPlan& plan, std::size_t rounds)
  : plan_(plan)
  , sides_(sides)
  , bands_(objects.staticObject.material->bands)
  , numbers_(objects)
{
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    materials_.push_back(objects[object].material);
  }
  roundSize_ = numbers_.size() * static_cast<std::size_t>(sides_) * plan.replicates().count() *
    static_cast<std::size_t>(bands_);
  setRounds(rounds);
}

void CellSums::replace(const SceneObjects& objects, const CancelPoint& cancelPoint)
{
  CellSums now(objects, sides_, plan_, 0);
  now.setRounds(rounds_, cancelPoint);
  for (std::size_t round = 0; round < rounds_; ++round)
  {
    for (std::uint32_t object = 0; object < objects.size(); ++object)
    {
      if (now.materials_[object] == materials_[object])
      {
        const CellSide first{ { object, 0 } };
        const auto size = static_cast<std::ptrdiff_t>(
          materials_[object]->numberOfCells * static_cast<std::size_t>(sides_) * sideSize());
        std::copy_n(sums_.begin() + static_cast<std::ptrdiff_t>(slot({ round, 0 }, first)), size,
          now.sums_.begin() + static_cast<std::ptrdiff_t>(now.slot({ round, 0 }, first)));
      }
      if (cancelPoint)
      {
        cancelPoint();
      }
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
  // With many replicates this is a lot of memory. Taken piece by piece, no step takes long.
  constexpr std::size_t kPiece = std::size_t{ 1 } << 20;
  std::vector<std::int64_t> sums;
  sums.reserve(rounds * roundSize_);
  while (sums.size() < rounds * roundSize_)
  {
    const std::size_t first = sums.size();
    const std::size_t end = std::min(first + kPiece, rounds * roundSize_);
    const auto old = sums_.begin();
    sums.insert(sums.end(), old + static_cast<std::ptrdiff_t>(std::min(first, sums_.size())),
      old + static_cast<std::ptrdiff_t>(std::min(end, sums_.size())));
    sums.resize(end);
    if (cancelPoint)
    {
      cancelPoint();
    }
  }
  sums_.swap(sums);
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

void CellSums::addCounts(std::int32_t* counts, std::int64_t quanta)
{
  for (std::size_t i = 0; i < sums_.size();)
  {
    const std::size_t part = i >> partShift(),
                      end = std::min((part + 1) << partShift(), sums_.size());
    const std::lock_guard<std::mutex> lock((*mutexes_)[part]);
    for (; i < end; ++i)
    {
      sums_[i] += counts[i] * quanta;
      counts[i] = 0;
    }
  }
}

void CellSums::add(const CellSums& others, const CancelPoint& cancelPoint)
{
  assert(others.sums_.size() == sums_.size());
  constexpr std::size_t kPiece = std::size_t{ 1 } << 20;
  for (std::size_t i = 0; i < sums_.size(); ++i)
  {
    sums_[i] += others.sums_[i];
    if (i % kPiece == 0 && cancelPoint)
    {
      cancelPoint();
    }
  }
}

void CellSums::sumOver(Ranks& ranks, const CancelPoint& cancelPoint)
{
  constexpr std::size_t kPiece = std::size_t{ 1 } << 18;
  for (std::size_t i = 0; i < sums_.size(); i += kPiece)
  {
    cancelPoint();
    ranks.sum(&sums_[i], std::min(kPiece, sums_.size() - i));
  }
}

std::int64_t CellSums::sum(const CellSide& cell, int band) const
{
  std::int64_t total = 0;
  for (std::uint32_t replicate = 0; replicate < plan_.replicates().count(); ++replicate)
  {
    total += sum(cell, band, replicate, rounds_);
  }
  return total;
}

std::int64_t CellSums::sum(
  const CellSide& cell, int band, std::uint32_t replicate, std::size_t rounds) const
{
  std::int64_t total = 0;
  for (std::size_t round = 0; round < rounds; ++round)
  {
    total += sums_[slot({ round, replicate }, cell) + static_cast<std::size_t>(band)];
  }
  return total;
}

}
