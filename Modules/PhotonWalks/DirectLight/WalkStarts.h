// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "DirectLight/DirectLight.h"

namespace irradiance
{

/**
 * The walks that start where direct light was gathered, each with the same power: as many from each
 * sample as what it reflects calls for, rounded up or down by chance, so that the mean is right.
 *
 * Walks are numbered as if all samples saw their lights. Those of samples that do not are not born;
 * so what stands in the light of some cells renumbers no others. Replicates take turns in the
 * numbers.
 */
class WalkStarts
{
public:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  /// `light`: with all its samples. `quantaPerWalk`: the power of a walk.
  WalkStarts(const DirectLight& light, const SceneObjects& objects, const SceneTriangles& triangles,
    std::int64_t quantaPerWalk, std::uint32_t firstWalk, std::uint64_t seed,
    const CancelPoint& cancelPoint = {});

  /// So many walks may be born, at least one number.
  std::uint32_t size() const { return static_cast<std::uint32_t>(startOfWalk_.size()); }
  bool isBorn(std::uint32_t walk) const
  {
    const std::uint32_t start = startOfWalk_[walk - firstWalk_];
    return start != kNone && isBorn(walk, light_.passedTo(starts_[start].sample));
  }
  /// How many are born.
  std::size_t numberBorn() const;
  /// That are in use.
  std::size_t bytes() const
  {
    return starts_.size() * sizeof(Start) + startOfWalk_.capacity() * sizeof(std::uint32_t);
  }
  /// The walks that start from these samples now, and did not before, or the other way round; in
  /// order.
  std::vector<std::uint32_t> walksOf(const std::vector<DirectLight::Change>& changes) const;

  /// Walks that leave the point of a sample alike.
  struct Start
  {
    std::uint32_t sample;
    std::uint32_t replicate, first, count; ///< walks, counted within the replicate
    Leaving leaving;
    Power power; ///< of each walk
  };
  const Start& operator[](std::uint32_t walk) const
  {
    return starts_[startOfWalk_[walk - firstWalk_]];
  }
  const DirectSample& sampleOf(const Start& start) const { return light_.samples()[start.sample]; }

private:
  /// Of a sample to which a part of the light comes, the same part of the walks: so chance says.
  bool isBorn(std::uint32_t walk, double passed) const
  {
    return passed > 0 && (passed == 1 || evenSample(walk, seed_) < passed);
  }
  /// In [0, 1). Of 32 walks in a row, from a multiple of 32 on, each has a 32nd of its own; what
  /// other such rows and seeds have is independent.
  static double evenSample(std::uint64_t walk, std::uint64_t seed);
  std::uint32_t numberOf(const Start& start, std::uint32_t walk) const
  {
    return firstWalk_ + walk * replicates_ + start.replicate;
  }
  void add(std::uint32_t sample, std::uint32_t replicate, const SceneObjects& objects,
    const SceneTriangles& triangles);
  void numberWalks(const CancelPoint& cancelPoint);

  const DirectLight& light_;
  std::int64_t quantaPerWalk_;
  std::uint32_t firstWalk_, replicates_;
  std::uint64_t seed_;
  std::vector<std::uint32_t> counts_;      ///< of walks, by replicate
  std::vector<Start> starts_;              ///< ordered by sample
  std::vector<std::uint32_t> startOfWalk_; ///< kNone: it is never born
};

}
