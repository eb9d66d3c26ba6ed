// SPDX-License-Identifier: BSD-3-Clause
#include "Views/ViewFinalGather.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace irradiance
{

ViewFinalGather::ViewFinalGather(const IrradianceEngine& engine, const CellShapes& shapes,
  std::uint32_t rays, bool asksOnLobes, bool keepsPaths, Execution& execution)
  : engine_(engine)
  , lights_(lightsOf(engine.walks(), engine.frame(), engine.settings().seed,
      asksOnLobes ? kSamplesOnLobe : kSamplesOfHit, Asked::All))
  , foundLamps_(foundLamps(engine.walks(), engine.cells().numbers()))
  , roles_(engine.cells(), engine.numberOfWalks(), engine.hasLights() ? rays : 0)
  , unevenCells_(unevenCells(CellShapes(engine.frame(), 0, 1, cancelPointOf(execution, 0)), roles_,
      engine.walks(), cancelPointOf(execution, 0)))
  , scene_{ engine.frame(), shapes, roles_, engine.sums(), nullptr, nullptr, engine.sums().rounds(),
    lights_, foundLamps_, unevenCells_, dealtRays(rays, engine.walks().plan().replicates().count()),
    engine.hasLights() ? 1 / engine.watts(1.0) : 0.0, // else a quantum is no power at all
    engine.settings().seed, keepsPaths }
{
  scene_.asksOnLobes = asksOnLobes;
}

std::vector<Bands> ViewFinalGather::replicatesOf(
  const PathSums& brought, std::size_t start, double factor) const
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

double standardErrorOf(const std::vector<double>& parts)
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
