// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "DirectLight/PointDirectLight.h"
#include "FinalGather/CellRoles.h"
#include "Tally/CellSums.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <deque>
#include <vector>

namespace irradiance
{

/// As many, rounded up so that each replicate has as many as the others.
inline std::uint32_t dealtRays(std::uint32_t rays, std::uint32_t replicates)
{
  return (rays + replicates - 1) / replicates * replicates;
}

/// What the paths of a final gather go through.
struct FinalGatherScene
{
  const Frame& frame;
  const CellShapes& shapes;
  CellRoles roles;
  // What cells are known to receive before, by side: one light would leak to the other where bodies
  // stick into each other.
  const CellSums& known;       ///< of cells that are read
  const CellSums* knownDirect; ///< direct light of all other cells; null: they know none
  const CellSums* knownStale;  ///< of `known`, what rests on stale walks, in one replicate; or null
  std::size_t knownRounds;     ///< of `known` and `knownDirect` that count
  const std::deque<PointDirectLight>& lights; ///< what points on near cells ask
  const std::vector<bool>& foundLamps;        ///< all else that shines, see foundLamps()
  const std::vector<bool>& unevenCells;       ///< see unevenCells()
  std::uint32_t rays;   ///< of a start, dealt to the replicates in blocks of equal size
  double quantaPerWatt; ///< of the light of all replicates
  std::uint64_t seed;
  bool keepsPaths; ///< for frames to come
  /// Where light is reflected along a lobe the lights are asked, points too; else a lamp counts
  /// where a path meets it.
  bool asksOnLobes = false;
  /// Whether the noise of rays is told from that of what they read.
  bool tellsNoise = false;
  const Light* sky = nullptr; ///< that counts where paths escape; null: none does
  std::uint32_t round = 0;    ///< of rays, see inRound()

  /// Whether what a cell received on average is read at any of its points.
  bool isRead(const SceneCell& cell) const
  {
    return roles.isRead(cell) && (unevenCells.empty() || !unevenCells[frame.cells.numbers()[cell]]);
  }
  std::uint32_t replicates() const { return known.plan().replicates().count(); }
  std::uint32_t raysOfReplicate() const { return rays / replicates(); }
  /// The number of the first ray of a side with so many starts: all rounds before have as many rays
  /// as this one.
  std::uint32_t firstRay(std::uint32_t starts) const { return round == 0 ? 0 : starts * rays; }
  /// This scene, which has the rays of the first round, with the rays of a later one. Each round
  /// doubles the number of rays, goes on with the samples of its start, and is dealt to the
  /// replicates in blocks of its own. So what the first rounds say does not depend on how many
  /// follow.
  FinalGatherScene inRound(std::size_t number) const
  {
    FinalGatherScene its = *this;
    its.round = static_cast<std::uint32_t>(number);
    its.rays = number == 0 ? rays : rays << (number - 1);
    return its;
  }
};

/// Starts whose rays are cast together: some thousand rays.
inline std::size_t startsTogether(const FinalGatherScene& scene)
{
  return std::max<std::size_t>(1, 4096 / scene.rays);
}

/// Rays of a start in its first `rounds` rounds, 1 or more. `first`: of the first round, > 0.
inline std::uint64_t raysAfter(std::uint32_t first, std::size_t rounds)
{
  return std::uint64_t{ first } << (rounds - 1);
}

/// As many rounds as do not exceed `most` rays, one at least.
inline std::size_t roundsWithin(std::uint32_t first, std::uint32_t most)
{
  assert(first > 0);
  std::size_t rounds = 1;
  while (raysAfter(first, rounds + 1) <= most)
  {
    ++rounds;
  }
  return rounds;
}

/// A round's part in the mean over the first `rounds`; a power of two.
inline double shareOfRound(std::size_t round, std::size_t rounds)
{
  return std::ldexp(1, static_cast<int>(round == 0 ? 1 : round) - static_cast<int>(rounds));
}

}
