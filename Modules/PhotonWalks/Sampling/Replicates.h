// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Replicates_h
#define irradiance_Replicates_h

#include <cstdint>

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

}

#endif
