// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkMergePoints.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace movingteapot
{
namespace
{

using Point = std::array<double, 3>;
using Weights = std::array<double, 4>;

// Cells over points that are told apart by their place alone.
struct MeshBuilder
{
  explicit MeshBuilder(const Box& bounds)
  {
    this->Merge->InitPointInsertion(this->Points, bounds.data());
    this->Mesh->SetPoints(this->Points);
    this->Mesh->SetPolys(this->Cells);
  }

  vtkIdType Insert(const Point& x)
  {
    vtkIdType id;
    this->Merge->InsertUniquePoint(x.data(), id);
    return id;
  }

  vtkNew<vtkPoints> Points;
  vtkNew<vtkMergePoints> Merge;
  vtkNew<vtkCellArray> Cells;
  vtkNew<vtkPolyData> Mesh;
};

// Where the cells begin and end along an axis of the box: the same numbers for all sides that have
// this axis, so that they meet bit for bit.
std::vector<double> CutAxis(const Box& box, int axis, double cellSize)
{
  const double length = box[2 * axis + 1] - box[2 * axis];
  const int count = std::max(1, int(std::ceil(length / cellSize - 1e-6)));
  std::vector<double> cuts;
  for (int i = 0; i < count; ++i)
  {
    cuts.push_back(box[2 * axis] + i * length / count);
  }
  cuts.push_back(box[2 * axis + 1]);
  return cuts;
}

// The cubic Bernstein polynomials at i / n. Made from whole numbers, they are exactly 1 and 0 at
// the ends and exactly the same read backwards; with the symmetric sum in Blend, two patches meet
// bit for bit along their common edge, whichever way each runs along it.
Weights BernsteinWeights(int i, int n)
{
  const double a = i, b = n - i;
  const double cube = double(n) * n * n;
  return { b * b * b / cube, 3 * a * b * b / cube, 3 * a * a * b / cube, a * a * a / cube };
}

Point Blend(const Weights& w, const Point* p)
{
  Point sum;
  for (int axis = 0; axis < 3; ++axis)
  {
    sum[axis] = (w[0] * p[0][axis] + w[3] * p[3][axis]) + (w[1] * p[1][axis] + w[2] * p[2][axis]);
  }
  return sum;
}

Point PatchPoint(const Patch& patch, const Weights& u, const Weights& v)
{
  const Point rows[4] = { Blend(v, &patch[0]), Blend(v, &patch[4]), Blend(v, &patch[8]),
    Blend(v, &patch[12]) };
  return Blend(u, rows);
}

void InsertPatch(const Patch& patch, int n, MeshBuilder& builder)
{
  std::vector<vtkIdType> grid;
  for (int i = 0; i <= n; ++i)
  {
    for (int j = 0; j <= n; ++j)
    {
      grid.push_back(
        builder.Insert(PatchPoint(patch, BernsteinWeights(i, n), BernsteinWeights(j, n))));
    }
  }
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j < n; ++j)
    {
      const vtkIdType a = grid[i * (n + 1) + j], b = grid[i * (n + 1) + j + 1];
      const vtkIdType c = grid[(i + 1) * (n + 1) + j + 1], d = grid[(i + 1) * (n + 1) + j];
      for (const auto& [p, q, r] : { std::array{ a, b, c }, std::array{ a, c, d } })
      {
        if (p != q && q != r && r != p) // else the triangle has collapsed at a pole
        {
          builder.Cells->InsertNextCell({ p, q, r });
        }
      }
    }
  }
}

}

vtkSmartPointer<vtkPolyData> MakeGridBox(
  const Box& box, double cellSize, Facing facing, const SideReflectances& reflectances)
{
  MeshBuilder builder(box);
  vtkNew<vtkDoubleArray> reflectance;
  reflectance->SetName("DiffuseReflectance");
  for (int side = 0; side < 6; ++side)
  {
    // The axis across the side and those along it are right-handed.
    const int across = side / 2, u = (across + 1) % 3, v = (across + 2) % 3;
    const bool counterclockwise = (facing == Facing::Outward) == (side % 2 == 1);
    const std::vector<double> us = CutAxis(box, u, cellSize), vs = CutAxis(box, v, cellSize);
    const auto insert = [&](std::size_t i, std::size_t j) {
      Point x;
      x[across] = box[side];
      x[u] = us[i];
      x[v] = vs[j];
      return builder.Insert(x);
    };
    for (std::size_t i = 1; reflectances[side] && i < us.size(); ++i)
    {
      for (std::size_t j = 1; j < vs.size(); ++j)
      {
        vtkIdType quad[4] = { insert(i - 1, j - 1), insert(i, j - 1), insert(i, j),
          insert(i - 1, j) };
        if (!counterclockwise)
        {
          std::swap(quad[1], quad[3]);
        }
        builder.Cells->InsertNextCell(4, quad);
        reflectance->InsertNextValue(*reflectances[side]);
      }
    }
  }
  builder.Mesh->GetCellData()->AddArray(reflectance);
  return builder.Mesh;
}

// A patch file (BPT): the number of patches, then of each its degrees, 3 3, and its points.
std::vector<Patch> ReadTeapotPatches()
{
  std::ifstream file(MOVINGTEAPOT_DATA "/UtahTeapot.bpt");
  std::size_t count = 0;
  file >> count;
  std::vector<Patch> patches(count);
  for (Patch& patch : patches)
  {
    int degrees[2];
    file >> degrees[0] >> degrees[1];
    for (Point& point : patch)
    {
      file >> point[0] >> point[1] >> point[2];
    }
  }
  if (!file || patches.empty())
  {
    throw std::runtime_error(MOVINGTEAPOT_DATA "/UtahTeapot.bpt cannot be read");
  }
  return patches;
}

void SetName(vtkPolyData* mesh, const std::string& name)
{
  vtkNew<vtkStringArray> array;
  array->SetName("Name");
  array->InsertNextValue(name);
  mesh->GetFieldData()->AddArray(array);
}

vtkSmartPointer<vtkPolyData> MakeUtahTeapot(int segments)
{
  MeshBuilder builder({ -3.0, 3.525, -2.0, 2.0, 0.0, 3.15 });
  for (const Patch& patch : ReadTeapotPatches())
  {
    InsertPatch(patch, segments, builder);
  }
  return builder.Mesh;
}

}
