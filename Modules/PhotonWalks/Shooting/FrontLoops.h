// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_FrontLoops_h
#define irradiance_FrontLoops_h

#include "Sampling/SampleGroup.h"
#include "Shooting/WalkFront.h"
#include "Surfaces/SceneTriangles.h"

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

/// Chooses lights and places on them.
struct StartLoop
{
  WalkFront& front; ///< in: walk, bounce = 0; out: start, weights, side
  const BounceKeys &lights, &positions;
  const std::vector<double>& cumulativeFlux; ///< W
  const std::uint32_t* triangles;            ///< of each light, or kNone
  std::uint32_t* chosen;                     ///< out: the light of each walk
};

/// Decides which walks survive by the thresholds of CellLook.
struct SurviveLoop
{
  SceneRows rows;
  WalkFront& front; ///< in: walk, bounce, hit; out: survivors
  const BounceKeys& keys;
};

/// Draws the samples alone, for the bounces to come.
struct DrawLoop
{
  WalkFront& front; ///< in: walk, bounce
  const BounceKeys& keys;
  std::uint32_t* samples; ///< out: first coordinates
};

/// Takes the survivors, in order and without gaps, from the front of their hits to the next one.
struct PackLoop
{
  const WalkFront& from;
  WalkFront& to;  ///< start, weights, side, walk, bounce, block, parent
  bool hasGlossy; ///< also isSpecular, the incoming directions and the origins
  int bands;      ///< if several: also the powers
};

/// Where the rays of walks begin, and their directions.
struct LeaveLoop
{
  SceneRows rows;
  WalkFront& front; ///< in: walk, bounce, start, weights, side; out: the ray
  const BounceKeys& keys;
};

/// Which sides the rays hit.
struct SidesLoop
{
  SceneRows rows;
  WalkFront& front; ///< in: direction, hit; out: hitSide
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

/// Each with the best instructions of the machine. All give the same bits.
void runStart(const StartLoop& loop);
void runSurvive(const SurviveLoop& loop);
void runDraw(const DrawLoop& loop);
void runPack(const PackLoop& loop);
void runLeave(const LeaveLoop& loop);
void runSides(const SidesLoop& loop);
void runSlots(const SlotsLoop& loop);

/// The loops of one instruction set.
#define IRRADIANCE_FRONT_LOOPS(level)                                                              \
  void runStart##level(const StartLoop& loop);                                                     \
  void runSurvive##level(const SurviveLoop& loop);                                                 \
  void runDraw##level(const DrawLoop& loop);                                                       \
  void runPack##level(const PackLoop& loop);                                                       \
  void runLeave##level(const LeaveLoop& loop);                                                     \
  void runSides##level(const SidesLoop& loop);                                                     \
  void runSlots##level(const SlotsLoop& loop);
IRRADIANCE_FRONT_LOOPS(Plain)
IRRADIANCE_FRONT_LOOPS(Avx2)
IRRADIANCE_FRONT_LOOPS(Avx512)
#undef IRRADIANCE_FRONT_LOOPS

}

#endif
