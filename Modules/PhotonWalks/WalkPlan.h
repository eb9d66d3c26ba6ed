#ifndef irradiance_WalkPlan_h
#define irradiance_WalkPlan_h

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace irradiance
{

/// Deals walks out to replicates in turn: walk w is number w / R of replicate w mod R. So the first
/// n walks are shared evenly for every n; the first n mod R replicates have one more.
class ReplicateDeal
{
public:
  explicit ReplicateDeal(std::uint32_t replicates = 1)
    : replicates_(replicates)
  {
  }

  std::uint32_t replicates() const { return replicates_; }
  std::uint32_t replicateOf(std::uint32_t walk) const
  {
    return replicates_ == 1 ? 0 : walk % replicates_;
  }
  std::uint32_t numberWithin(std::uint32_t walk) const
  {
    return replicates_ == 1 ? walk : walk / replicates_;
  }
  /// How many of the first `walks` walks a replicate has.
  std::uint32_t share(std::uint32_t replicate, std::uint32_t walks) const
  {
    return walks / replicates_ + (replicate < walks % replicates_ ? 1 : 0);
  }

private:
  std::uint32_t replicates_;
};

/// Walks [firstWalk, endWalk), stored in blocks [firstBlock, endBlock) of their own.
struct WalkRound
{
  std::uint32_t firstWalk, endWalk;
  std::size_t firstBlock, endBlock;
};

/**
 * Which walks may be shot, in which order: in rounds, each of which doubles the number of walks until
 * the limit is reached. Walk numbers, their replicates and their blocks do not depend on how many
 * rounds are shot in the end.
 */
class WalkPlan
{
public:
  /// All walks in one round, one replicate.
  WalkPlan()
    : WalkPlan(
        std::numeric_limits<std::uint32_t>::max(), std::numeric_limits<std::uint32_t>::max(), 1)
  {
  }
  /// 1 <= `first` <= `most`. With `first` == `most` there is one round.
  WalkPlan(std::uint32_t first, std::uint32_t most, std::uint32_t replicates);

  const std::vector<WalkRound>& rounds() const { return rounds_; }
  std::uint32_t most() const { return rounds_.back().endWalk; }
  const ReplicateDeal& deal() const { return deal_; }

  std::size_t roundOf(std::uint32_t walk) const
  {
    std::size_t round = 0;
    while (round + 1 < rounds_.size() && walk >= rounds_[round].endWalk)
    {
      ++round;
    }
    return round;
  }

  struct Place
  {
    std::size_t block;
    std::uint32_t walkInBlock;
  };
  Place placeOf(std::uint32_t walk) const;
  std::uint32_t firstWalkOf(std::size_t block) const;
  std::uint32_t walksIn(std::size_t block) const;

  friend bool operator==(const WalkPlan& a, const WalkPlan& b)
  {
    return a.rounds_.front().endWalk == b.rounds_.front().endWalk && a.most() == b.most() &&
      a.deal_.replicates() == b.deal_.replicates();
  }

private:
  const WalkRound& roundOfBlock(std::size_t block) const;

  ReplicateDeal deal_;
  std::vector<WalkRound> rounds_;
};

}

#endif
