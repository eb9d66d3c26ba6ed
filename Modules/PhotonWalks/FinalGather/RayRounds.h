// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_RayRounds_h
#define irradiance_RayRounds_h

#include "FinalGather/FinalGatherScene.h"

#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace irradiance
{

/**
 * The rays of a start, in rounds, of which each doubles their number. A round goes on with the
 * samples of its start, and is dealt to the replicates in blocks of its own. So what the first
 * rounds say does not depend on how many follow.
 */
class RayRounds
{
public:
  /// As many rounds as do not exceed `most` rays, one at least. `first`: rays of the first; > 0.
  RayRounds(std::uint32_t first, std::uint32_t most)
    : first_(first)
  {
    assert(first > 0);
    while (after(most_ + 1) <= most)
    {
      ++most_;
    }
  }

  std::size_t most() const { return most_; }
  /// Rays in the first `rounds` rounds, 1 or more.
  std::uint64_t after(std::size_t rounds) const { return std::uint64_t{ first_ } << (rounds - 1); }

  /// A round's part in the mean over the first `rounds`; a power of two.
  static double share(std::size_t round, std::size_t rounds)
  {
    return std::ldexp(1, static_cast<int>(round == 0 ? 1 : round) - static_cast<int>(rounds));
  }
  /// A scene with the rays of the first round, and those of a later one.
  static FinalGatherScene inRound(const FinalGatherScene& scene, std::size_t round)
  {
    FinalGatherScene its = scene;
    its.round = static_cast<std::uint32_t>(round);
    its.rays = round == 0 ? scene.rays : scene.rays << (round - 1);
    return its;
  }

private:
  std::uint32_t first_;
  std::size_t most_ = 1;
};

}

#endif
