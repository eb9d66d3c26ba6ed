// SPDX-License-Identifier: BSD-3-Clause
#include "UtahTeapot.h"

#include "UtahTeapotPatches.h"

#include <vtkCellArray.h>
#include <vtkMergePoints.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <vector>

namespace movingteapot
{
namespace
{

using Point = std::array<double, 3>;
using Weights = std::array<double, 4>;

// The cubic Bernstein polynomials at i / n. Made from whole numbers, they are exactly 1 and 0 at
// the ends and exactly the same read backwards; with the symmetric sum in Blend, two patches meet
// bit for bit along their common edge, whichever way each runs along it.
Weights BernsteinWeights(int i, int n)
{
  const double a = i, b = n - i;
  const double cube = double(n) * n * n;
  return { b * b * b / cube, 3 * a * b * b / cube, 3 * a * a * b / cube, a * a * a / cube };
}

Point Blend(const Weights& w, const Point& p0, const Point& p1, const Point& p2, const Point& p3)
{
  Point sum;
  for (int axis = 0; axis < 3; ++axis)
  {
    sum[axis] = (w[0] * p0[axis] + w[3] * p3[axis]) + (w[1] * p1[axis] + w[2] * p2[axis]);
  }
  return sum;
}

Point PatchPoint(const std::array<int, 16>& patch, const Weights& u, const Weights& v)
{
  std::array<Point, 4> row;
  for (int i = 0; i < 4; ++i)
  {
    const auto control = [&](int j) { return TeapotControlPoints[patch[4 * i + j] - 1]; };
    row[i] = Blend(v, control(0), control(1), control(2), control(3));
  }
  return Blend(u, row[0], row[1], row[2], row[3]);
}

// Ids of a patch's (n + 1)^2 grid of points; a point that is there already keeps its id.
std::vector<vtkIdType> InsertGrid(const std::array<int, 16>& patch, int n, vtkMergePoints* points)
{
  std::vector<vtkIdType> ids;
  for (int i = 0; i <= n; ++i)
  {
    for (int j = 0; j <= n; ++j)
    {
      const Point x = PatchPoint(patch, BernsteinWeights(i, n), BernsteinWeights(j, n));
      vtkIdType id;
      points->InsertUniquePoint(x.data(), id);
      ids.push_back(id);
    }
  }
  return ids;
}

void InsertTriangle(vtkIdType a, vtkIdType b, vtkIdType c, vtkCellArray* triangles)
{
  if (a != b && b != c && c != a)
  {
    triangles->InsertNextCell({ a, b, c });
  }
}

}

vtkSmartPointer<vtkPolyData> MakeUtahTeapot(int segments)
{
  const int n = segments;
  const double bounds[6] = { -3.0, 3.525, -2.0, 2.0, 0.0, 3.15 };
  vtkNew<vtkPoints> points;
  vtkNew<vtkMergePoints> merge;
  merge->InitPointInsertion(points, bounds);

  vtkNew<vtkCellArray> triangles;
  for (const auto& patch : TeapotPatches)
  {
    const std::vector<vtkIdType> grid = InsertGrid(patch, n, merge);
    for (int i = 0; i < n; ++i)
    {
      for (int j = 0; j < n; ++j)
      {
        const auto corner = [&](int di, int dj) { return grid[(i + di) * (n + 1) + j + dj]; };
        InsertTriangle(corner(0, 0), corner(0, 1), corner(1, 1), triangles);
        InsertTriangle(corner(0, 0), corner(1, 1), corner(1, 0), triangles);
      }
    }
  }

  auto teapot = vtkSmartPointer<vtkPolyData>::New();
  teapot->SetPoints(points);
  teapot->SetPolys(triangles);
  return teapot;
}

}
