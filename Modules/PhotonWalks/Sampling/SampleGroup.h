// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SampleGroup_h
#define irradiance_SampleGroup_h

#include "Sampling/SobolSequence.h"

#include <vector>

namespace irradiance
{

/// The sample keys of all walks for one use, at the first bounces: a table by bounce and replicate,
/// for lanes.
class BounceKeys
{
public:
  /// Further bounces are rare.
  static constexpr std::uint32_t kUsualBounces = 32;

  /// `samples` must outlive this. `bounces`: of the table, from 0 on.
  BounceKeys(const SobolSequence& samples, SampleUse use, std::uint32_t bounces = kUsualBounces)
    : samples_(&samples)
    , use_(use)
    , bounces_(bounces)
    , replicates_(samples.replicates().count())
    , firstWalk_(samples.replicates().firstWalk())
    , keys_(3 * size())
  {
    for (std::size_t i = 0; i < size(); ++i)
    {
      // The first walks are of one replicate each, in their order.
      const auto bounce = static_cast<std::uint32_t>(i / replicates_),
                 replicate = static_cast<std::uint32_t>(i % replicates_);
      const SampleKeys keys = samples.keysOf(firstWalk_ + replicate, bounce, use);
      keys_[i] = keys.shuffle;
      keys_[size() + i] = keys.scrambles[0];
      keys_[2 * size() + i] = keys.scrambles[1];
    }
  }

  const SobolSequence& samples() const { return *samples_; }
  SampleUse use() const { return use_; }
  std::uint32_t bounces() const { return bounces_; }
  std::uint32_t replicates() const { return replicates_; }
  std::uint32_t firstWalk() const { return firstWalk_; }

  /// By bounce, then by replicate.
  const std::uint32_t* shuffles() const { return keys_.data(); }
  const std::uint32_t* scramblesX() const { return keys_.data() + size(); }
  const std::uint32_t* scramblesY() const { return keys_.data() + 2 * size(); }

private:
  std::size_t size() const { return std::size_t{ bounces_ } * replicates_; }

  const SobolSequence* samples_;
  SampleUse use_;
  std::uint32_t bounces_, replicates_, firstWalk_;
  std::vector<std::uint32_t> keys_;
};

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
  __attribute__((always_inline)) void draw(const BounceKeys& keys, const std::uint32_t* walks,
    const std::uint32_t* bounces, std::uint32_t ahead)
  {
    setKeys(keys, walks, bounces, ahead);
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      const SobolPoint point(index[lane], shuffle[lane], scrambleX[lane], scrambleY[lane]);
      x[lane] = point.x;
      y[lane] = point.y;
    }
  }
  /// Only the first coordinates.
  __attribute__((always_inline)) void drawFirst(const BounceKeys& keys, const std::uint32_t* walks,
    const std::uint32_t* bounces, std::uint32_t ahead)
  {
    setKeys(keys, walks, bounces, ahead);
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      x[lane] = SobolPoint(index[lane], shuffle[lane], scrambleX[lane], 0).x;
    }
  }

private:
  __attribute__((always_inline)) void setKeys(const BounceKeys& keys, const std::uint32_t* walks,
    const std::uint32_t* bounces, std::uint32_t ahead)
  {
    const std::uint32_t first = bounces[0];
    std::uint32_t others = 0, most = 0;
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      others |= bounces[lane] ^ first;
      most = bounces[lane] > most ? bounces[lane] : most;
    }
    if (most + ahead >= keys.bounces())
    {
      lookUp(keys, walks, bounces, ahead);
    }
    else if (others != 0)
    {
      setMixed(keys, walks, bounces, ahead);
    }
    else if (keys.replicates() == 1)
    {
      setSame(keys, walks, first + ahead);
    }
    else
    {
      setReplicates(keys, walks, first + ahead);
    }
  }

  /// One replicate, one bounce.
  __attribute__((always_inline)) void setSame(
    const BounceKeys& keys, const std::uint32_t* walks, std::uint32_t bounce)
  {
    const std::uint32_t first = keys.firstWalk(), ofIndex = keys.shuffles()[bounce],
                        ofX = keys.scramblesX()[bounce], ofY = keys.scramblesY()[bounce];
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      index[lane] = walks[lane] - first;
      shuffle[lane] = ofIndex;
      scrambleX[lane] = ofX;
      scrambleY[lane] = ofY;
    }
  }

  /// One bounce.
  __attribute__((always_inline)) void setReplicates(
    const BounceKeys& keys, const std::uint32_t* walks, std::uint32_t bounce)
  {
    ReplicateLanes lanes;
    lanes.set(walks, keys.firstWalk(), keys.replicates());
    const std::size_t row = std::size_t{ bounce } * keys.replicates();
    const std::uint32_t *shuffles = keys.shuffles() + row, *scramblesX = keys.scramblesX() + row,
                        *scramblesY = keys.scramblesY() + row;
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      const std::uint32_t replicate = lanes.replicate[lane];
      index[lane] = lanes.number[lane];
      shuffle[lane] = shuffles[replicate];
      scrambleX[lane] = scramblesX[replicate];
      scrambleY[lane] = scramblesY[replicate];
    }
  }

  /// Bounces as repairs bring them, all in the table.
  __attribute__((always_inline)) void setMixed(const BounceKeys& keys, const std::uint32_t* walks,
    const std::uint32_t* bounces, std::uint32_t ahead)
  {
    const std::uint32_t count = keys.replicates(), first = keys.firstWalk();
    alignas(64) std::uint32_t place[kSize];
    if (count == 1)
    {
      for (unsigned lane = 0; lane < kSize; ++lane)
      {
        index[lane] = walks[lane] - first;
        place[lane] = bounces[lane] + ahead;
      }
    }
    else
    {
      ReplicateLanes lanes;
      lanes.set(walks, first, count);
      for (unsigned lane = 0; lane < kSize; ++lane)
      {
        index[lane] = lanes.number[lane];
        place[lane] = (bounces[lane] + ahead) * count + lanes.replicate[lane];
      }
    }
    const std::uint32_t *shuffles = keys.shuffles(), *scramblesX = keys.scramblesX(),
                        *scramblesY = keys.scramblesY();
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      shuffle[lane] = shuffles[place[lane]];
      scrambleX[lane] = scramblesX[place[lane]];
      scrambleY[lane] = scramblesY[place[lane]];
    }
  }

  /// Not for lanes: bounces may be any.
  __attribute__((noinline)) void lookUp(const BounceKeys& keys, const std::uint32_t* walks,
    const std::uint32_t* bounces, std::uint32_t ahead)
  {
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      const SampleKeys own = keys.samples().keysOf(walks[lane], bounces[lane] + ahead, keys.use());
      index[lane] = keys.samples().indexOf(walks[lane]);
      shuffle[lane] = own.shuffle;
      scrambleX[lane] = own.scrambles[0];
      scrambleY[lane] = own.scrambles[1];
    }
  }
};

}

#endif
