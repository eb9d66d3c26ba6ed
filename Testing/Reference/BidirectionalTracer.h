// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "CellSensors.h"
#include "Estimates.h"
#include "Execution/Execution.h"
#include "PathBatch.h"

namespace pathtracedroom
{

/**
 * Bidirectional path tracing (Lafortune and Willems 1993; Veach 1997, chapter 10) in a scene of the
 * engine. It shares the ray casting with vtkIrradianceFilter, and nothing that decides what light
 * does: so each can be checked against the other.
 *
 * Without bias: roulette ends subpaths, no depth does. Not found is what a mirror throws from a
 * point light onto a surface that a pinhole sees in a mirror. Surfaces that coincide are not told
 * apart, as they are in the filter (Contacts): a scene should have none.
 */
class BidirectionalTracer
{
public:
  struct Config
  {
    std::uint64_t seed = 1;
    irradiance::TraversalMode traversal = irradiance::TraversalMode::Parallel;
    std::function<bool(int, int)> isUsed; ///< see Strategies
  };

  /// `objects` and `sensor` must outlive it.
  BidirectionalTracer(
    const irradiance::SceneObjects& objects, const Sensor& sensor, const Config& config);

  /// What each bin measures, from `samples` pairs of subpaths for each bin. Passes are independent
  /// of each other; the result has the same bits for any number of threads and any traversal mode.
  /// Throws irradiance::Interrupted if `execution` says so.
  std::vector<Spectrum> trace(
    std::uint64_t pass, std::uint32_t samples, irradiance::Execution& execution) const;

private:
  const irradiance::SceneObjects& objects_;
  const Sensor& sensor_;
  std::uint64_t seed_;
  Lamps lamps_;
  Strategies strategies_;
  irradiance::Scene scene_;
};

/// What the bins of a sensor measure, and its error, from `passes` independent passes.
Estimates measure(const irradiance::SceneObjects& objects, const Sensor& sensor,
  const BidirectionalTracer::Config& config, int passes, std::uint32_t samples,
  irradiance::Execution& execution);

/// The irradiance of cells, W/m2, both sides summed, see CellIrradiance.
Estimates irradianceAt(const irradiance::SceneObjects& objects, const std::vector<CellId>& cells,
  const BidirectionalTracer::Config& config, int passes, std::uint32_t samples,
  irradiance::Execution& execution);

}
