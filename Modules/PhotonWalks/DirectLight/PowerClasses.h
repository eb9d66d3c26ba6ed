// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Lights/LightTable.h"
#include "Surfaces/SceneObjects.h"

#include <vector>

namespace irradiance
{

/**
 * Parts a table by how strong its lamps are, so that a weak lamp that shines where stronger ones do
 * not has walks and samples of its own: the lamp of a hut while the sun shines outside. A lamp is
 * all lights of an object that share corners, or a point. The strongest lamp has all lamps in its
 * class that are at least 0.15 times as strong, and those whose light falls mostly where the class
 * sends more than they do (see FirstHits); the strongest of the rest likewise. The last of at most
 * four classes has all others, and so has one if the rest is no more than `leastPart` of all flux.
 * A single class is the table itself.
 *
 * It depends on the lights and on the static object alone.
 */
std::vector<LightTable> powerClassesOf(
  const LightTable& lights, const SceneObjects& objects, double leastPart);

}
