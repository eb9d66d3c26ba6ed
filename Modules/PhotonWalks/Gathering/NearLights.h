// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_NearLights_h
#define irradiance_NearLights_h

#include "Lights/LightTable.h"
#include "Surfaces/SceneObjects.h"

#include <vector>

namespace irradiance
{

/**
 * Which lights of a table shine mostly on static triangles so near to them that what arrives differs much from
 * place to place: a strip along a wall, a lamp just over the floor. There walks that start at the light find the
 * light of a cell with less work than samples of the cell do.
 *
 * It depends on the lights and on the static object alone, so that no motion of others changes it.
 */
std::vector<bool> findNearLights(const SceneObjects& objects, const LightTable& lights);

}

#endif
