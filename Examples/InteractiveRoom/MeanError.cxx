// SPDX-License-Identifier: BSD-3-Clause
#include "MeanError.h"

#include <vtkCellData.h>
#include <vtkCellSizeFilter.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace interactiveroom
{
namespace
{

vtkSmartPointer<vtkDataArray> AreasOf(vtkPolyData* mesh)
{
  vtkNew<vtkCellSizeFilter> sizes;
  sizes->SetInputData(mesh);
  sizes->ComputeVertexCountOff();
  sizes->ComputeLengthOff();
  sizes->ComputeVolumeOff();
  sizes->Update();
  return sizes->GetPolyDataOutput()->GetCellData()->GetArray("Area");
}

// Of an irradiance or its error, three bands added up.
double ValueOf(vtkDataArray* values, vtkIdType cell)
{
  double sum = 0;
  for (int band = 0; band < values->GetNumberOfComponents(); ++band)
  {
    sum += values->GetComponent(cell, band);
  }
  return sum;
}

}

MeanError::MeanError(const Room& room)
{
  for (const StillThing& still : room.Still)
  {
    this->Areas.push_back(AreasOf(still.Mesh));
    this->IsLamp.push_back(still.IsLamp);
  }
  for (const MovingThing& moving : room.Moving)
  {
    this->Areas.push_back(AreasOf(moving.Mesh));
    this->IsLamp.push_back(false);
  }
}

double MeanError::Of(vtkMultiBlockDataSet* scene) const
{
  double error = 0, irradiance = 0; // W
  auto areas = this->Areas.begin();
  for (vtkPolyData* mesh : vtkCompositeDataSet::GetDataSets<vtkPolyData>(scene))
  {
    vtkDataArray* errors = mesh->GetCellData()->GetArray("IrradianceStandardError");
    vtkDataArray* values = mesh->GetCellData()->GetArray("Irradiance");
    for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
    {
      const double area = (*areas)->GetComponent(cell, 0);
      if (!std::isnan(errors->GetComponent(cell, 0)))
      {
        error += area * ValueOf(errors, cell);
        irradiance += area * ValueOf(values, cell);
      }
    }
    ++areas;
  }
  return irradiance > 0 ? error / irradiance : std::numeric_limits<double>::quiet_NaN();
}

double MeanError::Quantile(vtkMultiBlockDataSet* scene, double share) const
{
  std::vector<std::pair<double, double>> cells; // irradiance, area
  double all = 0;
  std::size_t number = 0;
  for (vtkPolyData* mesh : vtkCompositeDataSet::GetDataSets<vtkPolyData>(scene))
  {
    vtkDataArray* values = mesh->GetCellData()->GetArray("Irradiance");
    for (vtkIdType cell = 0; !this->IsLamp[number] && cell < mesh->GetNumberOfCells(); ++cell)
    {
      cells.emplace_back(ValueOf(values, cell), this->Areas[number]->GetComponent(cell, 0));
      all += cells.back().second;
    }
    ++number;
  }
  std::sort(cells.begin(), cells.end());
  double area = 0;
  for (const auto& [irradiance, own] : cells)
  {
    area += own;
    if (area >= share * all)
    {
      return irradiance;
    }
  }
  return 0;
}

}
