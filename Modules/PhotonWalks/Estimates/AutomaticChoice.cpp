// SPDX-License-Identifier: BSD-3-Clause
#include "Estimates/AutomaticChoice.h"

#include "FinalGather/CellRoles.h"
#include "FinalGather/PathLights.h"
#include "Walks/WalkSettings.h"

#include <algorithm>

namespace irradiance
{

namespace
{

/// What rays of a frame would find.
struct Reading
{
  double small = 0;                    ///< cells that gather
  double area = 0, areaThatIsRead = 0; ///< m2
};

Reading readingOf(const SceneCells& cells, double walks, std::uint32_t rays)
{
  const CellRoles roles(cells, walks, rays, GatherOn::Small);
  Reading reading;
  cells.numbers().forEach([&](const SceneCell& cell) {
    const double area = cells.area(cell);
    reading.small += roles.gathers(cell) ? 1 : 0;
    reading.area += area;
    reading.areaThatIsRead += roles.isRead(cell) ? area : 0;
  });
  return reading;
}

/// As many as are asked for, or as take as long as the walks; 0: they do not pay.
std::uint32_t raysThatPay(const SceneCells& cells, double walks, std::uint32_t asked)
{
  for (std::uint32_t rays = asked; rays > 0;
       rays = rays > kFewestRays ? std::max(kFewestRays, rays / 2) : 0)
  {
    const Reading reading = readingOf(cells, walks, rays);
    if (2 * reading.areaThatIsRead < reading.area)
    {
      return 0;
    }
    if (2.0 * rays * reading.small <= walks)
    {
      return rays;
    }
  }
  return 0;
}

double numberOf(const SceneCells& cells)
{
  double number = 0;
  cells.numbers().forEach([&](const SceneCell& cell) { number += cells.area(cell) > 0 ? 1 : 0; });
  return number;
}

}

void chooseByScene(const LeftToScene& left, const SceneObjects& objects, const SceneCells& cells,
  WalkSettings& walks, EstimateSettings& estimate)
{
  if (left.cellEstimate)
  {
    const bool mayGather =
      walks.gathersDirectLight && !estimate.unbiasedGather && !unseenLight(objects);
    const std::uint32_t rays =
      mayGather ? raysThatPay(cells, walks.numberOfWalks, estimate.gatherRays) : 0;
    estimate.cellEstimate = rays > 0 ? CellEstimate::Gathered : CellEstimate::Sums;
    estimate.gatherRays = rays > 0 ? rays : estimate.gatherRays;
  }
  if (left.directLight)
  {
    walks.gathersDirectLight =
      estimate.cellEstimate == CellEstimate::Gathered || numberOf(cells) <= walks.numberOfWalks;
  }
}

}
