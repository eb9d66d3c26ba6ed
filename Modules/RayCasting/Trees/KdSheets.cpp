// SPDX-License-Identifier: BSD-3-Clause
#include "Trees/KdSheets.h"

namespace irradiance
{

KdSheets::KdSheets(const KdItems& items, CheckpointPace& pace)
  : hull_(hullOf(items))
{
  for (const KdItem& item : items)
  {
    pace.step();
    const int face = faceOf(item);
    (face < kFaces ? sheets_[static_cast<std::size_t>(face)] : rest_).add(item);
  }
  isAny_ = rest_.count < items.size();
  for (const Part& sheet : sheets_)
  {
    isAny_ = isAny_ && sheet.count < items.size();
  }
}

int KdSheets::faceOf(const KdItem& item) const
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (item.lower[axis] == item.upper[axis])
    {
      for (const int face : { 2 * axis, 2 * axis + 1 })
      {
        if (item.lower[axis] == place(face))
        {
          return face;
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
  double sum = rest_.cost(cost, area);
  for (const Part& sheet : sheets_)
  {
    sum += sheet.count > 0 ? cost.traversal + sheet.cost(cost, area) : 0;
  }
  return sum;
}

}
