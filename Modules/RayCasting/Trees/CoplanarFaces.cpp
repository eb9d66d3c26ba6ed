// SPDX-License-Identifier: BSD-3-Clause
#include "Trees/CoplanarFaces.h"

#include <algorithm>

namespace irradiance
{

CoplanarFaces::CoplanarFaces(const KdItems& items, ThrottledCancelPoint& pace)
  : hull_(hullOf(items))
{
  for (const KdItem& item : items)
  {
    pace.step();
    std::size_t first = kFaces;
    for (std::size_t face = kFaces; face-- > 0;)
    {
      if (isIn(face, item))
      {
        ++counts_[face];
        first = face;
      }
    }
    parts_[first].add(item);
  }
}

bool CoplanarFaces::areAny() const
{
  return std::count_if(
           parts_.begin(), parts_.end(), [](const Part& part) { return part.count > 0; }) > 1;
}

bool CoplanarFaces::isIn(std::size_t face, const KdItem& item) const
{
  const std::size_t axis = face / 2;
  return item.lower[axis] == item.upper[axis] && item.lower[axis] == place(static_cast<int>(face));
}

double CoplanarFaces::costOfCuttingAll(const KdCost& cost, const Box& cell) const
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
