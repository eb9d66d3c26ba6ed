// SPDX-License-Identifier: BSD-3-Clause
#include "Smoothing.h"

#include "CellArea.h"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <vector>

namespace movingteapot
{
namespace
{

class Spreading
{
public:
  explicit Spreading(vtkPolyData* mesh)
    : Mesh(mesh)
    , PointAreas(mesh->GetNumberOfPoints(), 0.0)
  {
    for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
    {
      this->CellAreas.push_back(CellArea(mesh, cell));
      this->ForPointsOf(
        cell, [&](vtkIdType point) { this->PointAreas[point] += this->CellAreas[cell]; });
    }
  }

  void Pass(std::vector<double>& densities)
  {
    std::vector<double> powers(this->PointAreas.size(), 0.0);
    for (vtkIdType cell = 0; cell < vtkIdType(densities.size()); ++cell)
    {
      const double power = densities[cell] * this->CellAreas[cell];
      this->ForPointsOf(cell, [&](vtkIdType point) { powers[point] += power; });
    }
    for (vtkIdType cell = 0; cell < vtkIdType(densities.size()); ++cell)
    {
      double sum = 0.0;
      int count = 0;
      this->ForPointsOf(cell, [&](vtkIdType point) {
        sum += this->PointAreas[point] > 0.0 ? powers[point] / this->PointAreas[point] : 0.0;
        ++count;
      });
      densities[cell] = sum / count;
    }
  }

private:
  template <typename Action>
  void ForPointsOf(vtkIdType cell, Action action)
  {
    this->Mesh->GetCellPoints(cell, this->Ids);
    for (vtkIdType i = 0; i < this->Ids->GetNumberOfIds(); ++i)
    {
      action(this->Ids->GetId(i));
    }
  }

  vtkPolyData* Mesh;
  vtkNew<vtkIdList> Ids;
  std::vector<double> CellAreas, PointAreas; // m2; of a point: of all cells around it
};

}

void SmoothCellArray(vtkPolyData* mesh, const char* name, int passes)
{
  vtkDataArray* original = mesh->GetCellData()->GetArray(name);
  std::vector<double> densities(mesh->GetNumberOfCells());
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    densities[cell] = original->GetTuple1(cell);
  }
  Spreading spreading(mesh);
  for (int pass = 0; pass < passes; ++pass)
  {
    spreading.Pass(densities);
  }
  vtkNew<vtkDoubleArray> smooth;
  smooth->SetName(name);
  for (double density : densities)
  {
    smooth->InsertNextValue(density);
  }
  mesh->GetCellData()->AddArray(smooth);
}

}
