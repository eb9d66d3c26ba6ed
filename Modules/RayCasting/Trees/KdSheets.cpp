// SPDX-License-Identifier: BSD-3-Clause
#include "Trees/KdSheets.h"

#include <algorithm>

namespace irradiance
{

KdSheets::KdSheets(const KdItems& items, CheckpointPace& pace)
  : hull_(hullOf(items))
{
  for (const KdItem& item : items)
  {
    pace.step();
    parts_[faceOf(item)].add(item);
  }
}

bool KdSheets::areAny() const
{
  return std::count_if(
           parts_.begin(), parts_.end(), [](const Part& part) { return part.count > 0; }) > 1;
}

std::size_t KdSheets::faceOf(const KdItem& item) const
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (item.lower[axis] == item.upper[axis])
    {
      for (const int face : { 2 * axis, 2 * axis + 1 })
      {
        if (item.lower[axis] == place(face))
        {
          return static_cast<std::size_t>(face);
        }
      }
    }
  }
  return kFaces;
}

double KdSheets::costOfCuttingAll(const KdCost& cost, const Box& cell) const
{
  const Vector3 extent = cell.extent();
  const double area = extent[0] * extent[1] + extent[1] * extent[2] + extent[2] * extent[0];
  double sum = parts_[kFaces].cost(cost, area);
  for (std::size_t face = 0; face < kFaces; ++face)
  {
    sum += parts_[face].count > 0 ? cost.traversal + parts_[face].cost(cost, area) : 0;
  }
  return sum;
}

}
