// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IrradianceEngine.h"
#include "Walks/WalkSets.h"

#include <vector>

namespace irradiance
{

/// A stored walk, to look at.
struct WalkPath
{
  std::uint32_t walk;
  Power power; ///< with which it starts
  /// World space: the start on its light, then its hits. One that starts where direct light was
  /// gathered begins on the light from which that came. A walk that escapes has one more, where it
  /// is cut off.
  std::vector<Vector3> points;
  bool escapes;
  bool isStale; ///< part of it is no longer valid, see StaleWalks
  /// The first point that was shot again, see WalkSet::repaired(); else their number.
  std::size_t firstRepaired;
};

/**
 * Chooses among the stored walks of an engine, and hands them out as polylines. Points follow from
 * the triangles and weights of the hits, never from the floats that are kept for scans. So a
 * repaired walk has the same bits as a fresh one.
 *
 * The engine must keep the photons, and must not change meanwhile.
 */
class WalkPaths
{
public:
  explicit WalkPaths(const IrradianceEngine& engine);

  /// `most` walks, or all. Of walks that start at lights the first ones: as samples are a
  /// quasi-random sequence, any number of these is spread evenly over lights, places and
  /// directions; every tenth walk would not be. Walks that start where direct light was gathered
  /// are numbered cell by cell: of these some from everywhere, the same ones as long as they are
  /// born.
  std::vector<std::uint32_t> first(std::size_t most) const;
  /// The first `most` walks that start on a cell or hit it, or all of these. All ranks ask
  /// together. Throws Interrupted.
  std::vector<std::uint32_t> touching(
    const SceneCell& cell, std::size_t most, Execution& execution) const;
  /// In the order of `all`, which rise. All ranks ask together. Throws Interrupted.
  std::vector<WalkPath> paths(const std::vector<std::uint32_t>& all, Execution& execution) const;

private:
  std::vector<std::uint32_t> firstBorn(std::size_t most) const;
  /// Whether the first light of a walk comes from a cell, or it starts there.
  bool beginsOn(const SceneCell& cell, const WalkSet& set, std::uint32_t walk) const;
  /// Power, and the points before the first hit of a stored segment.
  void addStart(const Ray& first, WalkPath& path) const;
  bool isHit(
    const WalkHistory& history, std::size_t block, std::uint32_t walk, const SceneCell& cell) const;
  void find(const std::uint32_t* walks, std::size_t count, WalkPath* paths) const;
  void addHits(WalkPath& path) const;
  void addMarks(WalkPath& path) const;
  /// Where the ray of an escape is cut off: 1/8 of the diagonal of the scene beyond its box.
  Vector3 endOf(const Ray& ray) const;

  const IrradianceEngine& engine_;
  StoredWalks walks_;
  Box bounds_; ///< beyond which escapes are cut off
};

}
