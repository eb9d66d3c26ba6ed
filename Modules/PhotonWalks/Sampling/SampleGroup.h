// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Sampling/SobolSequence.h"

namespace irradiance
{

/// What walks side by side need to know of Replicates: the division for all lanes at once.
struct ReplicateLanes
{
  static constexpr unsigned kSize =
    32; ///< compilers unroll shorter loops, and then miss the vectors

  alignas(64) std::uint32_t replicate[kSize], number[kSize]; ///< number: within the replicate

  /// `count` > 1. The quotient of two integers below 2^32, rounded to a double, never reaches the
  /// next integer: it is 2^-32 or more away from it, relative to the divisor, and the rounding
  /// 2^-53.
  __attribute__((always_inline)) void set(
    const std::uint32_t* walks, std::uint32_t firstWalk, std::uint32_t count)
  {
    const double divisor = count;
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      const std::uint32_t walk = walks[lane] - firstWalk;
      // By way of a signed number, which SIMD converts faster.
      const double dividend = static_cast<std::int32_t>(walk ^ 0x80000000u) + 2147483648.0;
      const auto quotient =
        static_cast<std::uint32_t>(static_cast<std::int32_t>(dividend / divisor));
      number[lane] = quotient;
      replicate[lane] = walk - quotient * count;
    }
  }
};

/// Samples of walks side by side, as integers: the same as SobolSequence::sample() makes its
/// numbers of.
struct SampleGroup
{
  static constexpr unsigned kSize = ReplicateLanes::kSize;

  alignas(64) std::uint32_t index[kSize], shuffle[kSize], scrambleX[kSize], scrambleY[kSize];
  alignas(64) std::uint32_t x[kSize], y[kSize]; ///< the samples, in units of 2^-32

  /// Draws samples for the bounces given plus `ahead`. Is quickest for walks that are all at one
  /// bounce, quick for any bounces of the table of keys, and looks up all others walk by walk. Is
  /// compiled once for each instruction set.
  __attribute__((always_inline)) void draw(const SobolSequence& samples, SampleUse use,
    const std::uint32_t* walks, const std::uint32_t* bounces, std::uint32_t ahead)
  {
    setKeys(samples, use, walks, bounces, ahead);
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      const SobolPoint point(index[lane], shuffle[lane], scrambleX[lane], scrambleY[lane]);
      x[lane] = point.x;
      y[lane] = point.y;
    }
  }
  /// Only the first coordinates.
  __attribute__((always_inline)) void drawFirst(const SobolSequence& samples, SampleUse use,
    const std::uint32_t* walks, const std::uint32_t* bounces, std::uint32_t ahead)
  {
    setKeys(samples, use, walks, bounces, ahead);
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      x[lane] = SobolPoint(index[lane], shuffle[lane], scrambleX[lane], 0).x;
    }
  }

private:
  __attribute__((always_inline)) void setKeys(const SobolSequence& samples, SampleUse use,
    const std::uint32_t* walks, const std::uint32_t* bounces, std::uint32_t ahead)
  {
    const std::uint32_t first = bounces[0];
    std::uint32_t others = 0, most = 0;
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      others |= bounces[lane] ^ first;
      most = bounces[lane] > most ? bounces[lane] : most;
    }
    if (most + ahead >= SobolSequence::kKnownBounces)
    {
      lookUp(samples, use, walks, bounces, ahead);
    }
    else if (others != 0 || samples.replicates().count() > 1)
    {
      setMixed(samples, use, walks, bounces, ahead);
    }
    else
    {
      setSame(samples, use, walks, first + ahead);
    }
  }
  /// One replicate, one bounce.
  __attribute__((always_inline)) void setSame(
    const SobolSequence& samples, SampleUse use, const std::uint32_t* walks, std::uint32_t bounce)
  {
    const std::uint32_t first = samples.replicates().firstWalk();
    const SampleKeys keys = *samples.keysAt(bounce, use);
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      index[lane] = walks[lane] - first;
      shuffle[lane] = keys.shuffle;
      scrambleX[lane] = keys.scrambles[0];
      scrambleY[lane] = keys.scrambles[1];
    }
  }
  /// Several replicates, or bounces as repairs bring them, all known.
  __attribute__((always_inline)) void setMixed(const SobolSequence& samples, SampleUse use,
    const std::uint32_t* walks, const std::uint32_t* bounces, std::uint32_t ahead)
  {
    const std::uint32_t first = samples.replicates().firstWalk(),
                        count = samples.replicates().count();
    alignas(64) std::uint32_t row[kSize];
    if (count == 1)
    {
      for (unsigned lane = 0; lane < kSize; ++lane)
      {
        index[lane] = walks[lane] - first;
        row[lane] = (bounces[lane] + ahead) * SobolSequence::kUses;
      }
    }
    else
    {
      ReplicateLanes lanes;
      lanes.set(walks, first, count);
      for (unsigned lane = 0; lane < kSize; ++lane)
      {
        index[lane] = lanes.number[lane];
        row[lane] =
          (bounces[lane] + ahead) * (SobolSequence::kUses * count) + lanes.replicate[lane];
      }
    }
    const SampleKeys* const keys = samples.keysAt(0, use);
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      const SampleKeys& own = keys[row[lane]];
      shuffle[lane] = own.shuffle;
      scrambleX[lane] = own.scrambles[0];
      scrambleY[lane] = own.scrambles[1];
    }
  }
  /// Not for lanes: bounces may be any.
  __attribute__((noinline)) void lookUp(const SobolSequence& samples, SampleUse use,
    const std::uint32_t* walks, const std::uint32_t* bounces, std::uint32_t ahead)
  {
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      const SampleKeys own = samples.keysOf(walks[lane], bounces[lane] + ahead, use);
      index[lane] = samples.indexOf(walks[lane]);
      shuffle[lane] = own.shuffle;
      scrambleX[lane] = own.scrambles[0];
      scrambleY[lane] = own.scrambles[1];
    }
  }
};

}
