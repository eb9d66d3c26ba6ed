// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Ray.h"
#include "Scenes/BenchmarkScene.h"

/// Rays of a kind. Directions have unit length. Origins lie off the surface, so that no rival needs
/// a rule against meeting the surface that a ray leaves; all numbers fit a float, so that all see
/// the same rays.
struct RaySet
{
  char letter;
  std::vector<irradiance::Ray> rays;
};

/// I: from anywhere on the surfaces, by area, cosine-distributed: photons that bounce.
/// P: from the light, the directions next to each other in tiles: photons that start.
/// O: as I, but not from the walls, if there are any.
std::vector<RaySet> makeRaySets(const BenchmarkScene& scene, std::uint32_t count);
