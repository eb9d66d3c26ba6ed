// SPDX-License-Identifier: BSD-3-Clause
#include "Estimates/AutomaticChoice.h"

#include "FinalGather/CellRoles.h"
#include "FinalGather/PathLights.h"
#include "Geometry/Vector.h"
#include "Walks/WalkSet.h"

#include <algorithm>
#include <vector>

namespace irradiance
{

namespace
{

/// As many as are asked for, or as take about as long as all else; 0: they do not pay.
std::uint32_t raysThatPay(const SceneCells& cells, double walks, std::uint32_t asked)
{
  constexpr double kRaysPerWalk = 1.2; // cells gather direct light beside the walks
  for (std::uint32_t rays = asked; rays > 0;
       rays = rays > kFewestRays ? std::max(kFewestRays, rays / 2) : 0)
  {
    const CellRoles roles(cells, walks, rays);
    double small = 0, all = 0, read = 0; // cells that gather; m2
    cells.numbers().forEach([&](const SceneCell& cell) {
      const double area = cells.area(cell);
      small += roles.gathers(cell) ? 1 : 0;
      all += area;
      read += roles.isRead(cell) ? area : 0;
    });
    if (2 * read < all)
    {
      return 0;
    }
    if (2.0 * rays * small <= kRaysPerWalk * walks)
    {
      return rays;
    }
  }
  return 0;
}

/// Squared error of small cells, beside the light that they have from other surfaces, if each draws
/// on so many photons that walks bring to its object, or on all of these: the mean over the small
/// cells. What differs over the surface from which these come is blurred.
double errorOfPhotons(const SceneCells& cells, double walks, std::uint32_t rays, double photons)
{
  const CellRoles roles(cells, walks, rays);
  std::vector<double> areas, small; // m2, and a number, by object
  cells.numbers().forEach([&](const SceneCell& cell) {
    areas.resize(std::max<std::size_t>(areas.size(), cell.object + 1));
    small.resize(areas.size());
    areas[cell.object] += cells.area(cell);
    small[cell.object] += roles.gathers(cell) ? 1 : 0;
  });
  double noise = 0, number = 0;
  for (std::size_t object = 0; object < areas.size(); ++object)
  {
    if (small[object] > 0)
    {
      constexpr double kBlur = 0.01; // of all of a surface, as in the hall of SpeedAndAccuracy.md
      const double all = roles.expectedOn(areas[object]), drawn = std::min(photons, all);
      noise += small[object] * (1 / drawn + kBlur * drawn / all);
      number += small[object];
    }
  }
  return number > 0 ? noise / number : kInfinity;
}

/// Of the light that small cells gather from lights of this variance, see DirectPilot. That is of
/// static cells; few of these are so near to lamps that they have most of it.
double noiseOfSamples(double variance)
{
  constexpr double kOfVariance = 0.2, kMost = 0.015;
  return std::min(kOfVariance * variance, kMost);
}

/// Whether rays are less noise for their time than photons. What is here is measured in rooms:
/// Documentation/Theory.md, 1.3.
bool doRaysPay(const LightSurvey& survey, std::uint32_t rays, double errorOfPhotons)
{
  // Sobol' points in even light have less noise than so many others.
  constexpr double kGain = 8, kTime = 1.5;
  const double noiseOfRays = (survey.unevenness() - 1) / (kGain * rays);
  // Small cells that cast rays gather what lights send that are hard to find, too.
  const double gathered = noiseOfSamples(survey.gatheredVariance());
  const double hidden = noiseOfSamples(survey.hiddenVariance());
  return kTime * (noiseOfRays + gathered + hidden) <= errorOfPhotons + gathered;
}

double numberOf(const SceneCells& cells)
{
  double number = 0;
  cells.numbers().forEach([&](const SceneCell& cell) { number += cells.area(cell) > 0 ? 1 : 0; });
  return number;
}

}

void chooseByScene(const LeftToScene& left, const SceneObjects& objects, const SceneCells& cells,
  const std::function<const LightSurvey&()>& survey, WalkSettings& walks,
  EstimateSettings& estimate)
{
  bool isFine = estimate.cellEstimate == CellEstimate::Gathered;
  if (left.cellEstimate)
  {
    const bool mayRead =
      walks.gathersDirectLight && !estimate.unbiasedGather && unseenLight(objects, {}).empty();
    const std::uint32_t rays =
      mayRead ? raysThatPay(cells, walks.numberOfWalks, estimate.gatherRays) : 0;
    const bool isGathered = rays > 0 &&
      doRaysPay(
        survey(), rays, errorOfPhotons(cells, walks.numberOfWalks, rays, estimate.spreadPhotons));
    estimate.cellEstimate = estimate.unbiasedGather ? CellEstimate::Sums
      : isGathered                                  ? CellEstimate::Gathered
                                                    : CellEstimate::Spread;
    estimate.gatherRays = isGathered ? rays : estimate.gatherRays;
    isFine = rays > 0;
  }
  if (left.directLight)
  {
    const bool mayGather = isFine || numberOf(cells) <= walks.numberOfWalks;
    // What moves gathers anew at each step. Where small cells draw on photons that has to pay as
    // well.
    constexpr double kMostCost = 0.4;
    walks.gathersDirectLight = mayGather &&
      (estimate.cellEstimate != CellEstimate::Spread || survey().gatheringCost() < kMostCost);
  }
}

}
