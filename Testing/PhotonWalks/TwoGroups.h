// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_test_TwoGroups_h
#define irradiance_test_TwoGroups_h

#include "Surfaces/SceneObjects.h"

namespace irradiance::test
{

/// The scene with its point lights, all on the static object, in a group of their own: two sets of
/// walks.
inline SceneObjects inTwoGroups(const SceneObjects& objects)
{
  Emission emission = *objects.staticObject.emission;
  emission.groups.assign(objects.staticObject.material->numberOfCells, 0);
  for (const PointSource& source : emission.points)
  {
    emission.groups[source.cell] = 1;
  }
  SceneObjects grouped = objects;
  grouped.staticObject.emission = std::make_shared<const Emission>(std::move(emission));
  return grouped;
}

}

#endif
