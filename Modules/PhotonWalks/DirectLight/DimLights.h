// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_DimLights_h
#define irradiance_DimLights_h

#include "DirectLight/FirstHits.h"

namespace irradiance
{

/**
 * Lights of a group about as bright as what the scene sends that they light: warm walls of an oven,
 * a room that shines everywhere. Light from everywhere is found by any ray, and cells that looked
 * for it would choose among thousands of lights that bring little each. So walks start at them, and
 * rays of a final gather count what they emit where they meet it.
 *
 * It depends on the lights and on the static object alone.
 */
class DimLights
{
public:
  /// `hits`: of the lights of a group. What it lights itself counts: to rays a lamp in a hut is
  /// bright, however strong the sun is outside. `reflected`: the mean part of static cells.
  DimLights(const SceneObjects& objects, const FirstHits& hits, double reflected);

  /// Whether the light of a table is one of them.
  bool contains(const Light& light) const;

private:
  const SceneObjects& objects_;
  double brightest_ = 0; ///< W/m2 of all bands together
};

}

#endif
