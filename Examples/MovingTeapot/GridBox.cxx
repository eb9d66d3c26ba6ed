// SPDX-License-Identifier: BSD-3-Clause
#include "GridBox.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkMergePoints.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>

namespace movingteapot
{
namespace
{

// One of the six sides while it is cut into cells.
class Side
{
public:
  Side(const Box& box, double cellSize, int index)
    : Bounds(box)
    , Normal(index / 2)
    , AtMaximum(index % 2 == 1)
    , U((this->Normal + 1) % 3)
    , V((this->Normal + 2) % 3)
    , CountU(this->CountOf(this->U, cellSize))
    , CountV(this->CountOf(this->V, cellSize))
  {
  }

  // Quads whose front looks along the outer normal, or against it.
  int InsertCells(bool outward, vtkMergePoints* points, vtkCellArray* quads) const
  {
    const bool counterclockwise = outward == this->AtMaximum;
    for (int i = 0; i < this->CountU; ++i)
    {
      for (int j = 0; j < this->CountV; ++j)
      {
        vtkIdType quad[4] = { this->InsertPoint(i, j, points), this->InsertPoint(i + 1, j, points),
          this->InsertPoint(i + 1, j + 1, points), this->InsertPoint(i, j + 1, points) };
        if (!counterclockwise)
        {
          std::swap(quad[1], quad[3]);
        }
        quads->InsertNextCell(4, quad);
      }
    }
    return this->CountU * this->CountV;
  }

private:
  double Minimum(int axis) const { return this->Bounds[2 * axis]; }
  double Maximum(int axis) const { return this->Bounds[2 * axis + 1]; }

  int CountOf(int axis, double cellSize) const
  {
    const double count = (this->Maximum(axis) - this->Minimum(axis)) / cellSize;
    return std::max(1, int(std::ceil(count - 1e-6)));
  }

  // The same numbers on every side that has this axis, so that sides meet bit for bit.
  double Coordinate(int axis, int i, int count) const
  {
    return i == count
      ? this->Maximum(axis)
      : this->Minimum(axis) + i * (this->Maximum(axis) - this->Minimum(axis)) / count;
  }

  vtkIdType InsertPoint(int i, int j, vtkMergePoints* points) const
  {
    double x[3];
    x[this->Normal] = this->AtMaximum ? this->Maximum(this->Normal) : this->Minimum(this->Normal);
    x[this->U] = this->Coordinate(this->U, i, this->CountU);
    x[this->V] = this->Coordinate(this->V, j, this->CountV);
    vtkIdType id;
    points->InsertUniquePoint(x, id);
    return id;
  }

  Box Bounds;
  int Normal; // axis across the side
  bool AtMaximum;
  int U, V; // axes along the side; Normal, U, V are right-handed
  int CountU, CountV;
};

}

vtkSmartPointer<vtkPolyData> MakeGridBox(
  const Box& box, double cellSize, Facing facing, const SideReflectances& reflectances)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkMergePoints> merge;
  merge->InitPointInsertion(points, box.data());
  vtkNew<vtkCellArray> quads;
  vtkNew<vtkDoubleArray> reflectance;
  reflectance->SetName("DiffuseReflectance");

  for (int side = 0; side < 6; ++side)
  {
    if (!reflectances[side])
    {
      continue;
    }
    const bool outward = facing == Facing::Outward;
    const int count = Side(box, cellSize, side).InsertCells(outward, merge, quads);
    for (int i = 0; i < count; ++i)
    {
      reflectance->InsertNextValue(*reflectances[side]);
    }
  }

  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(quads);
  mesh->GetCellData()->AddArray(reflectance);
  return mesh;
}

}
