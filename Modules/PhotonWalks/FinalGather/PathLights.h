// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "FinalGather/FinalGatherScene.h"
#include "Walks/WalkSets.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <string>

namespace irradiance
{

/// Of a point that a path hits, see lightsOf(): the path is one of many.
constexpr std::uint32_t kSamplesOfHit = 4;

/// Which lights are asked.
enum class Asked
{
  All,
  ButSky,  ///< rays escape to it
  Gathered ///< by cells
};

/// Lights, but those of foundLamps(), for points that ask them by themselves, whether walks start
/// there or cells gather what they send. The arguments must outlive what is returned. `samples`: of
/// each point, for each group of lights.
std::deque<PointDirectLight> lightsOf(const WalkSets& walks, const Frame& frame, std::uint64_t seed,
  std::uint32_t samples, Asked which, std::size_t mostWeights = LampChoice::kMost);

/// "object 1, cell 2".
std::string numbersOf(const SceneCell& cell);

/// What is wrong with a point light that specular cells reflect, and what may be done; empty if
/// there is none. A path meets no point, and the sums of walks do not tell what came by way of
/// which reflection: so no final gather knows that light. `gather`: what does not know it.
/// `nameOf`: names a cell for the user.
std::string unseenLight(const SceneObjects& objects, const std::string& gather,
  const std::function<std::string(const SceneCell&)>& nameOf = numbersOf);

/// Throws InputError for an unseenLight().
void checkLights(const SceneObjects& objects, const std::string& gather,
  const std::function<std::string(const SceneCell&)>& nameOf = numbersOf);

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
