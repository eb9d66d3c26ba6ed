// SPDX-License-Identifier: BSD-3-Clause
#include "FinalGather/DarkShapes.h"

#include "DirectLight/DarkSides.h"
#include "FinalGather/PathLights.h"

#include <algorithm>
#include <vector>

namespace irradiance
{

CellShapes darkShapesOf(
  const WalkSets& walks, const WalkSpace& space, const CancelPoint& cancelPoint)
{
  std::vector<Box> lights;
  forEachLight(walks, [&](const Light& light) { lights.push_back(light.bounds()); });
  CellShapes shapes(space.objects, space.triangles, 0, space.objects.size(), cancelPoint);
  const std::vector<WalkSet>& sets = walks.sets();
  const bool areGathered = std::any_of(
    sets.begin(), sets.end(), [](const WalkSet& set) { return set.gathered() != nullptr; });
  if (areGathered) // else solid sides have not been found
  {
    markInnerSides(shapes, space.gatherSpace(), space.objects, lights);
  }
  markOuterSides(shapes, walks.bounds(space.scene));
  return shapes;
}

}
