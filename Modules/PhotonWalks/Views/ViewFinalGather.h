// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "FinalGather/FinalGatherPaths.h"
#include "FinalGather/PathLights.h"
#include "FinalGather/PathSums.h"
#include "IrradianceEngine.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <numeric>
#include <vector>

namespace irradiance
{

/// What a cell sends to an eye, W/m2/sr, or what a sensor receives, W/m2, by band.
struct ViewedLight
{
  Bands value{};
  /// From the variance between replicates; NaN where it is not known: without replicates, or where
  /// none of them found anything.
  Bands standardError{};
};

/**
 * The final gather of what looks at a frame: sensors, and the specular cells that an eye sees.
 * Paths read the sums of large cells, by side; where these say nothing they ask the lights and go
 * on. Each replicate has its own paths, which read its own sums. Theory.md, 5.8.
 */
class ViewFinalGather
{
public:
  /// Of the present frame of an engine, which must not change meanwhile.
  /// `shapes`: of cells that are starts; they must outlive it. `rays`: of a
  /// start; rounded up to a multiple of the replicates. `asksOnLobes`, `keepsPaths`: see
  /// FinalGatherScene. Throws Interrupted.
  ViewFinalGather(const IrradianceEngine& engine, const CellShapes& shapes, std::uint32_t rays,
    bool asksOnLobes, bool keepsPaths, Execution& execution)
    : engine_(engine)
    , lights_(lightsOf(engine.walks(), engine.frame(), engine.settings().seed,
        asksOnLobes ? kSamplesOnLobe : kSamplesOfHit, Asked::All))
    , foundLamps_(foundLamps(engine.walks(), engine.cells().numbers()))
    , roles_(engine.cells(), engine.numberOfWalks(), engine.hasLights() ? rays : 0)
    , unevenCells_(unevenCells(CellShapes(engine.frame(), 0, 1, cancelPointOf(execution, 0)),
        roles_, engine.walks(), cancelPointOf(execution, 0)))
    , scene_{ engine.frame(), shapes, roles_, engine.sums(), nullptr, nullptr,
      engine.sums().rounds(), lights_, foundLamps_, unevenCells_,
      dealtRays(rays, engine.walks().plan().replicates().count()),
      engine.hasLights() ? 1 / engine.watts(1.0) : 0.0, // else a quantum is no power at all
      engine.settings().seed, keepsPaths }
  {
    scene_.asksOnLobes = asksOnLobes;
  }

  const FinalGatherScene& scene() const { return scene_; }
  /// The paths that addStarts(FinalGatherPaths) adds. Throws std::runtime_error for a path that
  /// does not end. May be called by several threads.
  template <class AddStarts>
  FollowedPaths follow(const AddStarts& addStarts) const
  {
    return FinalGatherPaths::follow(paths_, scene_, addStarts);
  }
  /// W/m2 that came to the `start`-th start, times a factor: each replicate's part.
  std::vector<Bands> replicatesOf(const PathSums& brought, std::size_t start, double factor) const
  {
    std::vector<Bands> replicates(scene_.replicates());
    for (std::uint32_t k = 0; k < replicates.size(); ++k)
    {
      const Bands& quanta = brought.found(start, k);
      std::transform(quanta.begin(), quanta.end(), replicates[k].begin(),
        [&](double quantaPerArea) { return engine_.watts(factor * quantaPerArea); });
    }
    return replicates;
  }

private:
  // Lobes are many, and rays find what these neglect.
  static constexpr std::uint32_t kSamplesOnLobe = 2;

  const IrradianceEngine& engine_;
  std::deque<PointDirectLight> lights_;
  std::vector<bool> foundLamps_;
  CellRoles roles_;
  std::vector<bool> unevenCells_;
  FinalGatherScene scene_;
  mutable Pool<FinalGatherPaths> paths_; ///< what threads work with
};

/// The standard error of a sum of which each replicate has its part, from their scatter: NaN with a
/// single replicate, or if none has anything.
inline double standardErrorOf(const std::vector<double>& parts)
{
  const auto count = static_cast<double>(parts.size());
  const double sum = std::accumulate(parts.begin(), parts.end(), 0.0);
  double squares = 0;
  for (const double part : parts)
  {
    squares += (count * part - sum) * (count * part - sum);
  }
  return count > 1 && sum > 0 ? std::sqrt(squares / (count * (count - 1)))
                              : std::numeric_limits<double>::quiet_NaN();
}

}
