// SPDX-License-Identifier: BSD-3-Clause
#include "FinalGather/NearLampLight.h"

namespace irradiance
{

namespace
{

/// As in a room, see DirectPlan.
constexpr double kWalksPerSample = 36;

/// All sides of cells that do not gather count as dark: they take no samples.
CellShapes gatheringAlone(const FinalGatherScene& scene)
{
  CellShapes shapes = scene.shapes;
  scene.frame.cells.numbers().forEach([&](const SceneCell& cell) {
    if (!scene.roles.gathers(cell))
    {
      shapes.setDark(scene.frame.cells.numbers()[cell], true, true);
    }
  });
  return shapes;
}

}

void addNearLampLight(const FinalGatherScene& scene, const WalkSet& set, std::size_t rounds,
  CellSums& sums, Execution& execution)
{
  const CancelPoint cancelPoint = cancelPointOf(execution, 0);
  const LightTable& lights = set.lights();
  const std::uint32_t walks = set.source().plan.walksAfter(rounds);
  const std::uint32_t replicates = sums.plan().replicates().count();
  const double quantaPerWatt = static_cast<double>(lights.quantaPerWalk()) * walks / lights.flux();
  const std::shared_ptr<const LampPieces> known = set.source().knownLamps();
  const LampPieces& lamps = *known;
  const CellShapes shapes = gatheringAlone(scene);
  const DirectPlan plan(shapes, lamps,
    { walks, { kWalksPerSample, { scene.rays, scene.rays, 2 * scene.rays } }, replicates },
    cancelPoint);
  DirectLight light(
    shapes, lamps, plan, splitMix(scene.seed + set.source().firstWalk), quantaPerWatt);
  light.gather(scene.frame, execution);
  light.addTo(sums, 0, 1, {}, cancelPoint);
}

}
