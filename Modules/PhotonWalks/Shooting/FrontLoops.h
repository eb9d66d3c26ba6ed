// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Sampling/SampleGroup.h"
#include "Shooting/WalkFront.h"
#include "Simd/SimdLevel.h"
#include "Surfaces/SceneTriangles.h"

#include <vector>

namespace irradiance
{

/// What the loops over lanes of WalkStages read of a scene. Every number has rows, also kNone and
/// what was never written: then any record will do, and the look is the last one, with which
/// nothing survives.
struct SceneRows
{
  explicit SceneRows(const SceneTriangles& triangles)
    : records(triangles.records())
    , looks(triangles.looks())
    , size(triangles.size())
  {
  }

  __attribute__((always_inline)) const SurfaceRecord* recordOf(std::uint32_t number) const
  {
    return records + (number < size ? number : 0);
  }
  __attribute__((always_inline)) const CellLook* lookOf(std::uint32_t number) const
  {
    return looks + (number < size ? number : size);
  }

  const SurfaceRecord* records; ///< one or more
  const CellLook* looks;        ///< `size` + 1
  std::uint32_t size;           ///< triangles
};

/// Where the tally adds photons: sums of a round are numbered by cell, side, replicate and band.
struct SlotsLoop
{
  SceneRows rows;
  const WalkFront& front; ///< walk, hit, hitSide
  std::size_t first, end; ///< walks; `first` begins a group
  std::uint32_t perCell, perSide, perReplicate;
  std::uint32_t replicates, firstWalk;
  std::uint32_t escaped; ///< the slot of what hits nothing
  std::uint32_t* slots;  ///< out: of each of these walks, in whole groups
};

/// The loops of one instruction set. All sets give the same bits.
struct FrontLoops
{
  /// Chooses lights and places on them. Reads walk and bounce, which is 0; writes start, weights,
  /// side, and the light as candidate. `cumulativeFlux`: W. `triangles`: of each light, or kNone.
  void (*start)(WalkFront& front, const SobolSequence& samples,
    const std::vector<double>& cumulativeFlux, const std::uint32_t* triangles);
  /// Decides which walks survive by the thresholds of CellLook. Reads walk, bounce and hit; writes
  /// survivors, and the first coordinates of the samples as candidate.
  void (*survive)(WalkFront& front, SceneRows rows, const SobolSequence& samples);
  /// Draws the samples alone, for the bounces to come. Reads walk and bounce; writes the first
  /// coordinates as candidate.
  void (*draw)(WalkFront& front, const SobolSequence& samples);
  /// Takes the survivors, in order and without gaps, to the next front: start, weights, side, walk,
  /// bounce, block, parent. `hasGlossy`: also leaving, the incoming directions and the origins.
  /// Several bands: also the powers.
  void (*pack)(const WalkFront& from, WalkFront& to, bool hasGlossy, int bands);
  /// Where the rays of walks begin, and their directions. Reads walk, bounce, start, weights and
  /// side; writes the ray.
  void (*leave)(WalkFront& front, SceneRows rows, const SobolSequence& samples);
  /// Which sides the rays hit. Reads direction and hit; writes hitSide.
  void (*findSides)(WalkFront& front, SceneRows rows);
  void (*findSlots)(const SlotsLoop& loop);
};

const FrontLoops& frontLoopsPlain();
const FrontLoops& frontLoopsAvx2();
const FrontLoops& frontLoopsAvx512();

/// With the best instructions of the machine.
inline const FrontLoops& frontLoops()
{
  return IRRADIANCE_CALL_BEST(frontLoops, );
}

}
