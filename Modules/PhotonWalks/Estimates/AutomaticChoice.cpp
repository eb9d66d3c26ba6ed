// SPDX-License-Identifier: BSD-3-Clause
#include "Estimates/AutomaticChoice.h"

#include "FinalGather/CellRoles.h"
#include "FinalGather/PathLights.h"
#include "Walks/WalkSettings.h"

namespace irradiance
{

namespace
{

/// Of the objects that are there.
double countCells(const SceneObjects& objects)
{
  double cells = 0;
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    cells += objects[i].isPresent ? static_cast<double>(objects[i].material->numberOfCells) : 0;
  }
  return cells;
}

}

void AutomaticChoice::make(const LeftToScene& left, const SceneObjects& objects,
  WalkSettings& walks, EstimateSettings& estimate, const CancelPoint& cancelPoint)
{
  const double cells = countCells(objects), most = kMostForWalk * walks.numberOfWalks;
  if (left.cellEstimate)
  {
    // What costs most to find out comes last: no areas are measured of huge meshes.
    const bool pays = walks.gathersDirectLight && 2.0 * estimate.gatherRays * cells <= most &&
      !unseenLight(objects) && isToBeRead(objects, walks, estimate, cancelPoint);
    estimate.cellEstimate = pays ? CellEstimate::Gathered : CellEstimate::Sums;
  }
  if (left.directLight)
  {
    walks.gathersDirectLight =
      estimate.cellEstimate == CellEstimate::Gathered || walks.fewestSamples.small * cells <= most;
  }
}

bool AutomaticChoice::isToBeRead(const SceneObjects& objects, const WalkSettings& walks,
  const EstimateSettings& estimate, const CancelPoint& cancelPoint)
{
  cells_.update(objects, cancelPoint);
  const CellRoles roles(
    cells_, walks.numberOfWalks, estimate.gatherRays, estimate.gatherOn, !estimate.unbiasedGather);
  double area = 0, read = 0;
  cells_.numbers().forEach([&](const SceneCell& cell) {
    area += cells_.area(cell);
    read += roles.isRead(cell) ? cells_.area(cell) : 0;
  });
  return read >= kLeastRead * area;
}

}
