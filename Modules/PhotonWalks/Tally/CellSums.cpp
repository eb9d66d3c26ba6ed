// SPDX-License-Identifier: BSD-3-Clause
#include "Tally/CellSums.h"

#include <algorithm>

namespace irradiance
{

CellSums::CellSums(const SceneObjects& objects, int sides, const WalkPlan& plan, std::size_t rounds)
  : plan_(plan)
  , sides_(sides)
  , bands_(objects.staticObject.material->bands)
{
  std::size_t cells = 0;
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    firstCell_.push_back(cells);
    materials_.push_back(objects[object].material);
    cells += objects[object].material->numberOfCells;
  }
  roundSize_ = cells * static_cast<std::size_t>(sides_) * plan.replicates().count() *
    static_cast<std::size_t>(bands_);
  setRounds(rounds);
}

void CellSums::setRounds(std::size_t rounds, const Checkpoint& checkpoint)
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
    if (checkpoint)
    {
      checkpoint();
    }
  }
  sums_.swap(sums);
  rounds_ = rounds;
}

void CellSums::add(const std::vector<Deposit>& deposits)
{
  constexpr std::size_t kAhead = 16;
  const std::lock_guard<std::mutex> lock(*mutex_);
  for (std::size_t i = 0; i < deposits.size(); ++i)
  {
    prefetchLine(sums_.data() + deposits[std::min(i + kAhead, deposits.size() - 1)].slot);
    sums_[deposits[i].slot] += deposits[i].quanta;
  }
}

std::int64_t CellSums::sum(std::uint32_t object, std::size_t cell, int side, int band) const
{
  std::int64_t total = 0;
  for (std::uint32_t replicate = 0; replicate < plan_.replicates().count(); ++replicate)
  {
    total += sum(object, cell, side, band, replicate, rounds_);
  }
  return total;
}

std::int64_t CellSums::sum(std::uint32_t object, std::size_t cell, int side, int band,
  std::uint32_t replicate, std::size_t rounds) const
{
  std::int64_t total = 0;
  for (std::size_t round = 0; round < rounds; ++round)
  {
    total += sums_[slot({ round, replicate }, object, cell, side) + static_cast<std::size_t>(band)];
  }
  return total;
}

}
