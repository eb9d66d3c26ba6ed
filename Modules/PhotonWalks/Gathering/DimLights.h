// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_DimLights_h
#define irradiance_DimLights_h

#include "Gathering/FirstHits.h"

#include <vector>

namespace irradiance
{

/**
 * Lights about as bright as what the lit scene sends itself: warm walls of an oven, a room that shines everywhere. Light from everywhere
 * is found by any ray, and cells that looked for it would choose among thousands of lights that bring little each. So walks start
 * at them, and rays of a final gather count what they emit where they meet it.
 *
 * It depends on the lights and on the static object alone.
 */
class DimLights
{
public:
  /// `hits`: of the groups of lights, which have all lights together. `reflected`: the mean part of static cells.
  DimLights(const SceneObjects& objects, const std::vector<FirstHits>& hits, double reflected);

  /// Whether the light of a table is one of them.
  bool contains(const Light& light) const;

private:
  const SceneObjects& objects_;
  double brightest_ = 0; ///< W/m2 of all bands together
};

}

#endif
