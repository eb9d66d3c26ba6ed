// SPDX-License-Identifier: BSD-3-Clause
#include "ExposureSums.h"

#include "InputError.h"

#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"

#include <algorithm>
#include <cmath>

namespace irradiance
{

namespace
{

constexpr const char* kSuffixes[] = { "", "Front", "Back" };

bool hasCells(vtkDataSet* data)
{
  return data && data->GetNumberOfCells() > 0;
}

vtkDataArray* irradianceOf(vtkDataSet* data, const std::string& suffix)
{
  return data->GetCellData()->GetArray(("Irradiance" + suffix).c_str());
}

/// The values, as double.
vtkSmartPointer<vtkDoubleArray> asDouble(vtkDataArray* array)
{
  vtkSmartPointer<vtkDoubleArray> values = vtkDoubleArray::SafeDownCast(array);
  if (!values)
  {
    values = vtkSmartPointer<vtkDoubleArray>::New();
    values->DeepCopy(array);
  }
  return values;
}

void checkStale(vtkFieldData* fields, double time)
{
  vtkDataArray* stale = fields->GetArray("StalePower");
  if (stale && stale->GetNumberOfTuples() > 0 && stale->GetRange(-1)[1] > 0)
  {
    throw InputError("at time " + text(time) + " the input's StalePower is " +
      text(stale->GetRange(-1)[1]) +
      " W: its irradiance rests on walks that are no longer valid. Set the RepairTimeBudget of "
      "vtkIrradianceFilter to 0");
  }
}

}

void ExposureSums::checkStructure(const std::vector<LeafData>& leaves, double time)
{
  if (leaves_.empty())
  {
    firstTime_ = time;
    for (const LeafData& leaf : leaves)
    {
      leaves_.emplace_back();
      leaves_.back().name = leaf.name;
      leaves_.back().flatIndex = leaf.flatIndex;
    }
  }
  const bool isSame = std::equal(leaves.begin(), leaves.end(), leaves_.begin(), leaves_.end(),
    [](const LeafData& a, const Leaf& b) { return a.flatIndex == b.flatIndex; });
  if (!isSame)
  {
    throw InputError("the structure of the input differs: it has " +
      std::to_string(leaves_.size()) + " blocks at time " + text(firstTime_) + " and " +
      std::to_string(leaves.size()) + " blocks, or others, at time " + text(time) +
      ". A part that is not there is an empty block");
  }
}

void ExposureSums::begin(Leaf& leaf, vtkDataSet* data, double time)
{
  for (const char* suffix : kSuffixes)
  {
    if (vtkDataArray* array = irradianceOf(data, suffix))
    {
      const int bands = array->GetNumberOfComponents();
      const auto values = static_cast<std::size_t>(bands * data->GetNumberOfCells());
      leaf.sides.push_back({ suffix, bands, std::vector<double>(values) });
    }
  }
  if (leaf.sides.empty())
  {
    throw InputError(leaf.name + " has no cell array Irradiance, or IrradianceFront and " +
      "IrradianceBack, at time " + text(time) +
      ": connect the output of vtkIrradianceFilter, or data that have such arrays");
  }
}

void ExposureSums::checkCells(const Leaf& leaf, vtkDataSet* data, double time)
{
  if (leaf.geometry && leaf.geometry->GetNumberOfCells() != data->GetNumberOfCells())
  {
    throw InputError(leaf.name + " has " + std::to_string(leaf.geometry->GetNumberOfCells()) +
      " cells at time " + text(leaf.time) + ", but " + std::to_string(data->GetNumberOfCells()) +
      " at time " + text(time) + ": the exposure of a cell needs the same cells at all times");
  }
}

void ExposureSums::addSide(
  const std::string& name, Side& side, vtkDataSet* data, double time, double weight)
{
  vtkDataArray* array = irradianceOf(data, side.suffix);
  if (!array || array->GetNumberOfComponents() != side.bands)
  {
    throw InputError(name + ": the cell array Irradiance" + side.suffix + " has " +
      (array ? std::to_string(array->GetNumberOfComponents()) + " components" : "gone") +
      " at time " + text(time) + ", but " + std::to_string(side.bands) +
      " components at an earlier visited time");
  }
  const auto values = asDouble(array);
  const double* irradiance = values->GetPointer(0);
  double check = 0;
  for (std::size_t i = 0; i < side.exposure.size(); ++i)
  {
    side.exposure[i] += weight * irradiance[i];
    check += 0 * irradiance[i]; // NaN unless all are finite
  }
  if (std::isnan(check))
  {
    const auto* bad = std::find_if_not(irradiance, irradiance + side.exposure.size(),
      [](double value) { return std::isfinite(value); });
    throw InputError(name + ", cell " + std::to_string((bad - irradiance) / side.bands) +
      ": Irradiance" + side.suffix + " is " + text(*bad) + " at time " + text(time));
  }
}

void ExposureSums::add(vtkDataObject* data, double time, double weight)
{
  const std::vector<LeafData> leaves = leavesOf(data);
  checkStructure(leaves, time);
  checkStale(data->GetFieldData(), time);
  for (std::size_t i = 0; i < leaves.size(); ++i)
  {
    Leaf& leaf = leaves_[i];
    vtkDataSet* cells = leaves[i].data;
    if (!hasCells(cells))
    {
      continue;
    }
    checkCells(leaf, cells, time);
    if (!leaf.geometry)
    {
      begin(leaf, cells, time);
    }
    for (Side& side : leaf.sides)
    {
      addSide(leaf.name, side, cells, time, weight);
    }
    leaf.geometry = vtk::TakeSmartPointer(cells->NewInstance());
    leaf.geometry->ShallowCopy(cells);
    leaf.time = time;
  }
  energies_.add(data->GetFieldData(), weight);
}

vtkSmartPointer<vtkDataSet> ExposureSums::written(const Leaf& leaf, vtkDataSet* last)
{
  vtkDataSet* source = leaf.geometry ? leaf.geometry.Get() : last;
  if (!source)
  {
    return nullptr;
  }
  auto data = vtk::TakeSmartPointer(source->NewInstance());
  data->ShallowCopy(source);
  data->GetInformation()->Remove(vtkDataObject::DATA_TIME_STEP());
  vtkCellData* cells = data->GetCellData();
  for (const Side& side : leaf.sides)
  {
    for (const std::string& name : { "Irradiance" + side.suffix,
           "Irradiance" + side.suffix + "StandardError", "StaleIrradiance" + side.suffix })
    {
      cells->RemoveArray(name.c_str());
    }
    vtkNew<vtkDoubleArray> exposure;
    exposure->SetName(("RadiantExposure" + side.suffix).c_str());
    exposure->SetNumberOfComponents(side.bands);
    exposure->SetNumberOfTuples(data->GetNumberOfCells());
    std::copy(side.exposure.begin(), side.exposure.end(), exposure->GetPointer(0));
    cells->AddArray(exposure);
    if (side.suffix.empty())
    {
      cells->SetActiveScalars("RadiantExposure");
    }
  }
  return data;
}

void ExposureSums::write(vtkDataObject* last, vtkDataObject* output) const
{
  if (std::none_of(
        leaves_.begin(), leaves_.end(), [](const Leaf& leaf) { return leaf.geometry != nullptr; }))
  {
    throw InputError("the input has no cells at any of the times that were visited");
  }
  const std::vector<LeafData> leaves = leavesOf(last);
  fillLeaves(last, output, [&](std::size_t i) { return written(leaves_[i], leaves[i].data); });
  output->GetInformation()->Remove(vtkDataObject::DATA_TIME_STEP());
  energies_.write(output->GetFieldData());
}

}
