// SPDX-License-Identifier: BSD-3-Clause
#include "FinalGather/PathLights.h"

#include "Progress/InputError.h"

#include <string>

namespace irradiance
{

std::deque<PointDirectLight> lightsOf(const WalkSets& walks, const GatherSpace& space,
  std::uint64_t seed, std::uint32_t samples, std::size_t mostWeights)
{
  std::deque<PointDirectLight> lights;
  for (const WalkSet& set : walks.sets())
  {
    // The sets of dynamic cells have the same lights.
    if (set.source().cells != CellPart::Dynamic && !set.lights().isEmpty())
    {
      lights.emplace_back(space, set.lights(), seed + lights.size(), samples, mostWeights);
    }
  }
  return lights;
}

void checkLights(const WalkSets& walks, const SceneTriangles& triangles, const char* estimate)
{
  forEachLight(walks, [&](const Light& light) {
    if (triangles.hasGlossy() && std::holds_alternative<PointLight>(light.kind))
    {
      throw InputError(std::string(estimate) +
        " Gathered does not know how specular cells reflect the light of points: make them area "
        "lights, or choose another estimate");
    }
  });
}

}
