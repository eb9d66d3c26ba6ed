// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Sampling/SobolPoint.h"
#include "Sampling/WalkPlan.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

namespace irradiance
{

/// What a sample of a bounce is used for; each use has a two-dimensional pattern of its own.
enum class SampleUse : std::uint32_t
{
  Light,       ///< which light (first coordinate)
  Position,    ///< where on it
  Direction,   ///< in which direction the walk leaves
  Survival,    ///< whether and how the walk leaves the hit before this bounce (first coordinate)
  Acceptance,  ///< specular: whether the direction stays (first coordinate), see PhongLobe
  Compensation ///< specular: the direction if it does not
};

/**
 * Randomized quasi-Monte-Carlo samples as a pure function of (seed, walk, bounce, use): the first
 * two Sobol' dimensions, their index shuffled and each coordinate scrambled by hash-based nested
 * uniform (Owen) scrambling. Every pair is a (0,2)-sequence in the walks, pairs are independent,
 * and the depth is not limited. After Burley, "Practical Hash-based Owen Scrambling" (JCGT 2020),
 * with the hash of Vegdahl (2021). Coordinates are multiples of 2^-32 plus 2^-33, so never 0 or 1.
 *
 * Each replicate has a scrambling of its own and runs through the sequence from its start, so that
 * the estimates of replicates are independent. The first replicate has the scrambling of the seed.
 */
class SobolSequence
{
public:
  static constexpr std::uint32_t kUses = 6;
  static constexpr std::uint32_t kKnownBounces = 32; ///< more are rare

  explicit SobolSequence(std::uint64_t seed, const Replicates& replicates = Replicates())
    : replicates_(replicates)
  {
    for (std::uint32_t replicate = 0; replicate < replicates.count(); ++replicate)
    {
      seeds_.push_back(replicate == 0 ? seed : splitMix(splitMix(seed) + replicate));
    }
    for (std::uint32_t i = 0; i < kUses * kKnownBounces; ++i)
    {
      std::transform(seeds_.begin(), seeds_.end(), std::back_inserter(keys_),
        [i](std::uint64_t own) { return keysOf(own, i / kUses, i % kUses); });
    }
  }

  std::array<double, 2> sample(std::uint32_t walk, std::uint32_t bounce, SampleUse use) const
  {
    return SobolPoint::inUnitSquare(indexOf(walk), keysOf(walk, bounce, use));
  }

  const Replicates& replicates() const { return replicates_; }
  /// The number of a walk's point in its sequence.
  std::uint32_t indexOf(std::uint32_t walk) const { return replicates_.numberWithin(walk); }
  SampleKeys keysOf(std::uint32_t walk, std::uint32_t bounce, SampleUse use) const
  {
    const std::uint32_t replicate = replicates_.replicateOf(walk);
    return bounce < kKnownBounces
      ? keysAt(bounce, use)[replicate]
      : keysOf(seeds_[replicate], bounce, static_cast<std::uint32_t>(use));
  }
  /// Of all replicates, at one of the first kKnownBounces; kUses times as many at each bounce.
  const SampleKeys* keysAt(std::uint32_t bounce, SampleUse use) const
  {
    const std::size_t row = bounce * kUses + static_cast<std::uint32_t>(use);
    return keys_.data() + row * replicates_.count();
  }

private:
  static SampleKeys keysOf(std::uint64_t seed, std::uint32_t bounce, std::uint32_t use)
  {
    return SampleKeys(splitMix(seed ^ splitMix(std::uint64_t{ bounce } << 32 | use)));
  }

  Replicates replicates_;
  std::vector<std::uint64_t> seeds_; ///< of each replicate
  std::vector<SampleKeys> keys_;     ///< of the first bounces, their uses, and each replicate
};

}
