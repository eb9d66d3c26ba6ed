// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_LobeLight_h
#define irradiance_LobeLight_h

#include "FinalGather/FinalGatherScene.h"

namespace irradiance
{

/// A point from which light is reflected to where a path comes from.
struct PathVertex
{
  LitPoint point;   ///< on the side of the path
  Vector3 incoming; ///< unit vector, along the path
};

/**
 * The light that a lobe reflects straight from the lights is looked for in two ways: along the
 * lobe, where a ray may meet a lamp, and by asking the lights. What one finds easily the other does
 * not: narrow lobes, small lamps. Both together have the power heuristic of Veach and Guibas
 * (1995), so that nothing counts twice. Points in the air are asked alone; lamps in the same place
 * as the face are met alone.
 */

/// pi times the radiance, W/m2/sr, of what the lights bring, by asking them, for a specular
/// reflectance of 1. `number` and `share`: see PointDirectLight::taken().
Bands lobeLight(const FinalGatherScene& scene, const PathVertex& from, const PhongLobe& lobe,
  std::uint64_t number, std::uint32_t share);

/// The weight of a lamp that a ray meets at a place. `density`: of its direction, 1/sr, where it
/// left a lobe.
double lampWeight(const FinalGatherScene& scene, const Ray& ray, double density,
  const TriangleId& lamp, const Vector3& place);

}

#endif
