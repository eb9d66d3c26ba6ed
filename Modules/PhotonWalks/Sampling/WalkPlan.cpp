// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/WalkPlan.h"

#include <algorithm>

namespace irradiance
{

WalkPlan::WalkPlan(
  std::uint32_t first, std::uint32_t most, std::uint32_t replicates, std::uint32_t firstWalk)
  : replicates_(replicates, firstWalk)
{
  for (std::uint64_t walks = first; endWalk() - firstWalk < most; walks *= 2)
  {
    const auto all = static_cast<std::uint32_t>(std::min<std::uint64_t>(walks, most));
    addRound(firstWalk + all - endWalk());
  }
}

void WalkPlan::addRound(std::uint32_t walks)
{
  const std::size_t firstBlock = rounds_.empty() ? 0 : rounds_.back().endBlock;
  rounds_.push_back({ endWalk(), endWalk() + walks, firstBlock,
    firstBlock + (std::size_t{ walks } + kWalksPerBlock - 1) / kWalksPerBlock });
}

std::size_t WalkPlan::blockOf(std::uint32_t walk) const
{
  const WalkRound& round = rounds_[roundOf(walk)];
  return round.firstBlock + (walk - round.firstWalk) / kWalksPerBlock;
}

const WalkRound& WalkPlan::roundOfBlock(std::size_t block) const
{
  return *std::find_if(rounds_.begin(), rounds_.end(),
    [block](const WalkRound& round) { return block < round.endBlock; });
}

std::uint32_t WalkPlan::firstWalkOf(std::size_t block) const
{
  const WalkRound& round = roundOfBlock(block);
  return round.firstWalk + static_cast<std::uint32_t>(block - round.firstBlock) * kWalksPerBlock;
}

std::uint32_t WalkPlan::walksIn(std::size_t block) const
{
  return std::min<std::uint32_t>(kWalksPerBlock, roundOfBlock(block).endWalk - firstWalkOf(block));
}

}
