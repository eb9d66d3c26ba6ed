#ifndef RaySet_h
#define RaySet_h

#include "BenchmarkScene.h"
#include "Geometry/Ray.h"

/// Where the rays start.
enum class RaySet
{
  Surfaces, ///< I: anywhere on the surfaces, by area, cosine-distributed: photons that bounce
  Objects,  ///< O: the same, but not on the walls
  Light     ///< P: on the light, the directions next to each other in tiles: photons that start
};

char letterOf(RaySet set);

/// The sets that a scene has: O differs from I only where there are walls.
std::vector<RaySet> raySetsOf(const BenchmarkScene& scene);

/// Unit directions. Origins lie off the surface, so that no rival needs a rule against meeting the
/// surface that a ray leaves; all numbers are those of a float, so that all see the same rays.
std::vector<irradiance::Ray> makeRays(const BenchmarkScene& scene, RaySet set, std::uint32_t count);

#endif
