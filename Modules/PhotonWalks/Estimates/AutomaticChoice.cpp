// SPDX-License-Identifier: BSD-3-Clause
#include "Estimates/AutomaticChoice.h"

#include "FinalGather/CellRoles.h"
#include "FinalGather/PathLights.h"
#include "Walks/WalkSettings.h"

#include <algorithm>

namespace irradiance
{

static_assert(kFewestWalksOfCell >= 2 * CellRoles::kFewestToRead);

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

void chooseByScene(const LeftToScene& left, const SceneObjects& objects, WalkSettings& walks,
  EstimateSettings& estimate)
{
  const double cells = countCells(objects);
  if (left.cellEstimate)
  {
    const double walksOfCell = std::max(2.0 * estimate.gatherRays, kFewestWalksOfCell);
    const bool pays = walks.gathersDirectLight && !estimate.unbiasedGather &&
      cells * walksOfCell <= walks.numberOfWalks && !unseenLight(objects);
    estimate.cellEstimate = pays ? CellEstimate::Gathered : CellEstimate::Sums;
  }
  if (left.directLight)
  {
    walks.gathersDirectLight =
      estimate.cellEstimate == CellEstimate::Gathered || cells <= walks.numberOfWalks;
  }
}

}
