// SPDX-License-Identifier: BSD-3-Clause
#include "FinalGather/CellRoles.h"

#include "DirectLight/DarkSides.h"

#include <memory>

namespace irradiance
{

CellRoles::CellRoles(
  const SceneCells& cells, double walks, std::uint32_t rays, bool isEverywhere, bool readsCells)
  : cells_(cells)
  , isEverywhere_(isEverywhere)
  , readsCells_(readsCells)
  , photons_(kPhotonsPerRay * rays)
{
  double area = 0;
  cells.numbers().forEach([&](const SceneCell& cell) { area += cells.area(cell); });
  walksPerArea_ = area > 0 ? walks / area : 0;
}

std::vector<bool> unevenCells(const CellShapes& shapes, const CellRoles& roles,
  const WalkSets& walks, const CancelPoint& cancelPoint)
{
  // Lamps are near within so many radii of a cell: two to three edges of a square.
  constexpr double kNear = 2;
  constexpr double kMuch = 0.1; // the part of the light that may come from there
  std::vector<std::shared_ptr<const LampPieces>> lamps;
  std::vector<LampChoice> choices;
  for (const WalkSet& set : walks.sets())
  {
    const WalkSource& source = set.source();
    if (!source.lights.isEmpty() && (source.areNear || (source.cells && !source.isDynamic())))
    {
      lamps.push_back(source.knownLamps());
      choices.emplace_back(*lamps.back());
    }
  }
  std::vector<bool> areUneven;
  if (choices.empty())
  {
    return areUneven;
  }
  ThrottledCancelPoint pace(cancelPoint);
  std::size_t number = 0;
  shapes.numbers().forEach([&](const SceneCell& cell) {
    const CellShape& shape = shapes[number++];
    pace.step();
    const double reach = kNear * shape.radius;
    const auto mayBeNear = [&](const LampChoice& choice) { return choice.distance(shape) < reach; };
    if (cell.object > 0 || !roles.isRead(cell) ||
      std::none_of(choices.begin(), choices.end(), mayBeNear))
    {
      return;
    }
    double near = 0, all = 0;
    for (LampChoice& choice : choices)
    {
      all += choice.expectedPower(shape);
      near += choice.powerFromWithin(reach);
    }
    if (near > kMuch * all)
    {
      areUneven.resize(shapes.size());
      areUneven[number - 1] = true;
    }
  });
  return areUneven;
}

std::vector<bool> foundLamps(const WalkSets& walks, const CellNumbers& cells)
{
  std::vector<bool> areFound;
  for (const WalkSet& set : walks.sets())
  {
    const bool areLamps = set.source().areFoundByRays && !set.source().isSky();
    for (std::size_t i = 0; areLamps && i < set.lights().lights().size(); ++i)
    {
      areFound.resize(cells.size());
      areFound[cells[set.lights()[i].cell]] = true;
    }
  }
  return areFound;
}

CellShapes darkShapesOf(const WalkSets& walks, const Frame& frame, const CancelPoint& cancelPoint)
{
  std::vector<Box> lights;
  std::vector<const DistantLight*> distant;
  Box bounds = frame.scene.bounds();
  bool areGathered = false;
  for (const WalkSet& set : walks.sets())
  {
    areGathered = areGathered || set.gathered();
    for (const Light& light : set.lights().lights())
    {
      lights.push_back(light.stand());
      bounds.add(light.stand());
      if (light.distant())
      {
        distant.push_back(light.distant());
      }
    }
  }
  CellShapes shapes(frame, 0, frame.objects.size(), cancelPoint);
  if (areGathered) // else solid sides have not been found
  {
    markInnerSides(shapes, frame, lights);
  }
  markOuterSides(shapes, bounds, distant);
  return shapes;
}

}
