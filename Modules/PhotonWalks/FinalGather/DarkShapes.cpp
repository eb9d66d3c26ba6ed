// SPDX-License-Identifier: BSD-3-Clause
#include "FinalGather/DarkShapes.h"

#include "DirectLight/DarkSides.h"
#include "FinalGather/PathLights.h"

#include <algorithm>
#include <vector>

namespace irradiance
{

CellShapes darkShapesOf(const WalkSets& walks, const Frame& frame, const CancelPoint& cancelPoint)
{
  std::vector<Box> lights;
  forEachLight(walks, [&](const Light& light) { lights.push_back(light.bounds()); });
  CellShapes shapes(frame, 0, frame.objects.size(), cancelPoint);
  const std::vector<WalkSet>& sets = walks.sets();
  const bool areGathered = std::any_of(
    sets.begin(), sets.end(), [](const WalkSet& set) { return set.gathered() != nullptr; });
  if (areGathered) // else solid sides have not been found
  {
    markInnerSides(shapes, frame, lights);
  }
  markOuterSides(shapes, walks.bounds(frame.scene));
  return shapes;
}

}
