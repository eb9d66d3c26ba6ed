// SPDX-License-Identifier: BSD-3-Clause
#include "FinalGather/PathsOrigin.h"

#include "Repair/SceneChange.h"

namespace irradiance
{

PathsOrigin pathsOriginOf(const FinalGatherScene& scene)
{
  PathsOrigin origin{ scene.frame.objects, scene.seed, scene.rays, scene.replicates(), {}, {} };
  scene.frame.cells.numbers().forEach([&](const SceneCell& cell) {
    if (scene.isRead(cell))
    {
      origin.readCells.push_back(cell);
    }
  });
  for (const PointDirectLight& lights : scene.lights)
  {
    origin.lights.push_back(lights.lights().lights());
  }
  return origin;
}

std::optional<FinalGatherMotion> motionSince(
  const FinalGatherScene& scene, const PathsOrigin& now, const PathsOrigin& before)
{
  if (now.seed != before.seed || now.rays != before.rays || now.replicates != before.replicates ||
    now.readCells != before.readCells || hasReplaced(now.objects, before.objects) ||
    !differsOnlyByMotion(now.objects, before.objects) ||
    !areLightsUnchanged(now.objects, before.objects) || !(now.lights == before.lights))
  {
    return {};
  }
  return FinalGatherMotion(scene, findMoved(now.objects, before.objects));
}

}
