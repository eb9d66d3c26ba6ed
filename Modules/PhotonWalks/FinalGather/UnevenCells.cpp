// SPDX-License-Identifier: BSD-3-Clause
#include "FinalGather/UnevenCells.h"

#include <algorithm>
#include <memory>

namespace irradiance
{

namespace
{

/// Lamps are near within so many radii of a cell: two to three edges of a square.
constexpr double kNear = 2;
/// The part of the light that may come from there.
constexpr double kMuch = 0.1;

}

UnevenCells::UnevenCells(const CellShapes& shapes, const CellRoles& roles, const WalkSets& walks,
  const CancelPoint& cancelPoint)
{
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
  if (choices.empty())
  {
    return;
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
      areUneven_.resize(shapes.size());
      areUneven_[number - 1] = true;
    }
  });
}

}
