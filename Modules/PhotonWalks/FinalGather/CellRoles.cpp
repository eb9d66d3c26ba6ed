// SPDX-License-Identifier: BSD-3-Clause
#include "FinalGather/CellRoles.h"

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

}
