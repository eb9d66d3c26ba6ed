// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PathsOrigin_h
#define irradiance_PathsOrigin_h

#include "FinalGather/FinalGatherMotion.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace irradiance
{

/// What the paths of a final gather depend on besides their starts.
struct PathsOrigin
{
  SceneObjects objects;
  std::uint64_t seed;
  std::uint32_t rays, replicates;
  std::vector<SceneCell> readCells;
  std::vector<std::vector<Light>> lights; ///< in the groups that are asked
};

PathsOrigin pathsOriginOf(const FinalGatherScene& scene);

/// What moved since paths were followed; nothing if another thing changed, so that none of them can
/// be kept. `now`: of the scene.
std::optional<FinalGatherMotion> motionSince(
  const FinalGatherScene& scene, const PathsOrigin& now, const PathsOrigin& before);

}

#endif
