// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace irradiance
{

/// Assigns walks to replicates in turn: the w-th walk is number w / R (rounded down) of replicate w
/// mod R. So the first n walks are shared evenly for every n; the first n mod R replicates have one
/// more.
class Replicates
{
public:
  /// `firstWalk`: the number that the first walk has.
  explicit Replicates(std::uint32_t count = 1, std::uint32_t firstWalk = 0)
    : count_(count)
    , firstWalk_(firstWalk)
  {
  }

  std::uint32_t count() const { return count_; }
  std::uint32_t firstWalk() const { return firstWalk_; }
  std::uint32_t replicateOf(std::uint32_t walk) const
  {
    return count_ == 1 ? 0 : (walk - firstWalk_) % count_;
  }
  std::uint32_t numberWithin(std::uint32_t walk) const
  {
    return count_ == 1 ? walk - firstWalk_ : (walk - firstWalk_) / count_;
  }
  /// How many of the first `walks` walks a replicate has.
  std::uint32_t share(std::uint32_t replicate, std::uint32_t walks) const
  {
    return walks / count_ + (replicate < walks % count_ ? 1 : 0);
  }

private:
  std::uint32_t count_, firstWalk_;
};

/// Walks [firstWalk, endWalk), stored in blocks [firstBlock, endBlock) of their own.
struct WalkRound
{
  std::uint32_t firstWalk, endWalk;
  std::size_t firstBlock, endBlock;
};

/**
 * The walks that may be shot, in rounds. Each round doubles the number of walks until the limit is
 * reached. The numbers, replicates and blocks of walks do not depend on how many rounds are shot in
 * the end.
 */
class WalkPlan
{
public:
  /// Number of walks in a full block.
  static constexpr std::uint32_t kWalksPerBlock = 1024;

  /// All walks in one round, one replicate.
  WalkPlan()
    : WalkPlan(
        std::numeric_limits<std::uint32_t>::max(), std::numeric_limits<std::uint32_t>::max(), 1)
  {
  }
  /// 1 <= `first` <= `most` walks, numbered from `firstWalk` on. With `first` == `most` there is
  /// one round.
  WalkPlan(
    std::uint32_t first, std::uint32_t most, std::uint32_t replicates, std::uint32_t firstWalk = 0)
    : replicates_(replicates, firstWalk)
  {
    for (std::uint64_t walks = first; endWalk() - firstWalk < most; walks *= 2)
    {
      const auto all = static_cast<std::uint32_t>(std::min<std::uint64_t>(walks, most));
      addRound(firstWalk + all - endWalk());
    }
  }
  /// Has no rounds yet.
  explicit WalkPlan(const Replicates& replicates)
    : replicates_(replicates)
  {
  }

  /// Of 1 walk or more; with several replicates, of as many of each.
  void addRound(std::uint32_t walks)
  {
    const std::size_t firstBlock = rounds_.empty() ? 0 : rounds_.back().endBlock;
    rounds_.push_back({ endWalk(), endWalk() + walks, firstBlock,
      firstBlock + (std::size_t{ walks } + kWalksPerBlock - 1) / kWalksPerBlock });
  }
  void dropRounds(std::size_t kept) { rounds_.resize(kept); }

  const std::vector<WalkRound>& rounds() const { return rounds_; }
  std::uint32_t most() const { return walksAfter(rounds_.size()); }
  /// The number of walks in the first `rounds` rounds, 1 or more.
  std::uint32_t walksAfter(std::size_t rounds) const
  {
    return rounds_[rounds - 1].endWalk - rounds_.front().firstWalk;
  }
  /// One more than the number of the last walk.
  std::uint32_t endWalk() const
  {
    return rounds_.empty() ? replicates_.firstWalk() : rounds_.back().endWalk;
  }
  const Replicates& replicates() const { return replicates_; }

  std::size_t roundOf(std::uint32_t walk) const
  {
    std::size_t round = 0;
    while (round + 1 < rounds_.size() && walk >= rounds_[round].endWalk)
    {
      ++round;
    }
    return round;
  }

  /// The block that holds a walk.
  std::size_t blockOf(std::uint32_t walk) const
  {
    const WalkRound& round = rounds_[roundOf(walk)];
    return round.firstBlock + (walk - round.firstWalk) / kWalksPerBlock;
  }
  std::uint32_t firstWalkOf(std::size_t block) const
  {
    const WalkRound& round = roundOfBlock(block);
    return round.firstWalk + static_cast<std::uint32_t>(block - round.firstBlock) * kWalksPerBlock;
  }
  std::uint32_t walksIn(std::size_t block) const
  {
    return std::min<std::uint32_t>(
      kWalksPerBlock, roundOfBlock(block).endWalk - firstWalkOf(block));
  }

  friend bool operator==(const WalkPlan& a, const WalkPlan& b)
  {
    const WalkRound &first = a.rounds_.front(), &other = b.rounds_.front();
    return first.firstWalk == other.firstWalk && first.endWalk == other.endWalk &&
      a.endWalk() == b.endWalk() && a.replicates_.count() == b.replicates_.count();
  }

private:
  const WalkRound& roundOfBlock(std::size_t block) const
  {
    return *std::find_if(rounds_.begin(), rounds_.end(),
      [block](const WalkRound& round) { return block < round.endBlock; });
  }

  Replicates replicates_;
  std::vector<WalkRound> rounds_;
};

/// The blocks of a plan that one rank of several works on. They are dealt in turn, so that each
/// round is shared evenly.
class DealtBlocks
{
public:
  /// All blocks.
  DealtBlocks() = default;
  DealtBlocks(std::size_t rank, std::size_t ranks)
    : rank_(rank)
    , ranks_(ranks)
  {
  }

  /// The number in the plan of the i-th of these.
  std::size_t operator[](std::size_t i) const { return rank_ + i * ranks_; }
  bool contains(std::size_t block) const { return block % ranks_ == rank_; }
  /// How many of these have lower numbers.
  std::size_t before(std::size_t block) const
  {
    return ranks_ == 1 ? block : (block + ranks_ - 1 - rank_) / ranks_;
  }

  friend bool operator==(const DealtBlocks& a, const DealtBlocks& b)
  {
    return a.rank_ == b.rank_ && a.ranks_ == b.ranks_;
  }

private:
  std::size_t rank_ = 0, ranks_ = 1;
};

}
