// SPDX-License-Identifier: BSD-3-Clause
#ifndef PolygonNormal_h
#define PolygonNormal_h

#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkPolyData.h"

#include <array>

/// Normal of a polygon in one plane, convex or not, as long as twice its area. vtkPolygon's has
/// float's rounding in VTK 9.3.
inline std::array<double, 3> PolygonNormal(vtkPolyData* polyData, vtkIdList* ids)
{
  std::array<double, 3> sum{};
  for (vtkIdType i = 2; i < ids->GetNumberOfIds(); ++i)
  {
    double a[3], b[3], c[3], normal[3];
    polyData->GetPoint(ids->GetId(0), a);
    polyData->GetPoint(ids->GetId(i - 1), b);
    polyData->GetPoint(ids->GetId(i), c);
    vtkMath::Subtract(b, a, b);
    vtkMath::Subtract(c, a, c);
    vtkMath::Cross(b, c, normal);
    vtkMath::Add(sum.data(), normal, sum.data());
  }
  return sum;
}

#endif
