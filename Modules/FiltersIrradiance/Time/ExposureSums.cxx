// SPDX-License-Identifier: BSD-3-Clause
#include "Time/ExposureSums.h"

#include "Data/ArrayNames.h"
#include "Data/NamedArray.h"
#include "Exposure/ExposureSpread.h"
#include "Input/PolyDataConverter.h"
#include "Progress/InputError.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>

namespace irradiance
{

namespace
{

using Leaf = ExposureSums::Leaf;
using Side = ExposureSums::Side;

std::string errorName(const std::string& suffix)
{
  return standardErrorName(irradianceName(suffix));
}

vtkDataArray* arrayOf(vtkDataSet* data, const std::string& name)
{
  return data->GetCellData()->GetArray(name.c_str());
}

/// The sides of which there is irradiance.
std::vector<const char*> sidesIn(vtkDataSetAttributes* values)
{
  std::vector<const char*> sides;
  std::copy_if(kSideSuffixes.begin(), kSideSuffixes.end(), std::back_inserter(sides),
    [&](const char* suffix) { return values->GetArray(irradianceName(suffix).c_str()); });
  return sides;
}

/// The light groups that have an array of irradiance of their own.
std::vector<std::string> groupsIn(vtkCellData* cells, const std::string& suffix)
{
  const std::string start = nameOfGroup(irradianceName(suffix), ""), end = standardErrorName("");
  std::vector<std::string> groups;
  for (int i = 0; i < cells->GetNumberOfArrays(); ++i)
  {
    const std::string name =
      cells->GetArray(i) && cells->GetArrayName(i) ? cells->GetArrayName(i) : "";
    const bool isError =
      name.size() >= end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
    if (!isError && name.compare(0, start.size(), start) == 0)
    {
      groups.push_back(name.substr(start.size()));
    }
  }
  return groups;
}

/// The values of an array that an earlier time had, with so many components.
SharedValues checkedValues(const std::string& leaf, vtkDataSet* data, const std::string& name,
  std::size_t components, double time)
{
  vtkDataArray* array = arrayOf(data, name);
  throwIf(!array || static_cast<std::size_t>(array->GetNumberOfComponents()) != components, leaf,
    ": the cell array ", name, " has ",
    array ? joined(array->GetNumberOfComponents(), " components") : "gone", " at time ", time,
    ", but ", components, " components at an earlier visited time");
  return valuesOf(array);
}

/// Throws InputError for sensors, whose values belong to points.
void checkCellValues(const LeafData& leaf)
{
  throwIf(leaf.data && sidesIn(leaf.data->GetCellData()).empty() &&
      (!sidesIn(leaf.data->GetPointData()).empty() ||
        leaf.data->GetPointData()->HasArray(kFluenceRate) != 0),
    leaf.name,
    " has the light of points, as vtkIrradianceProbeFilter makes it, and a dose is one of cells: "
    "give each sensor a normal, and a vertex cell by vtkVertexGlyphFilter, before that filter, and "
    "put vtkPointDataToCellData behind it");
}

void checkStale(vtkFieldData* fields, double time)
{
  vtkDataArray* stale = fields->GetArray(kStalePower);
  const double watts = stale && stale->GetNumberOfTuples() > 0 ? stale->GetRange(-1)[1] : 0;
  throwIf(watts > 0, "at time ", time, " the input's StalePower is ", watts,
    " W: its irradiance rests on walks that are no longer valid. Set the RepairTimeBudget of "
    "vtkIrradianceFilter to 0");
}

Side newSide(const std::string& leaf, const std::string& suffix, vtkDataSet* data)
{
  const int bands = arrayOf(data, irradianceName(suffix))->GetNumberOfComponents();
  const auto values = static_cast<std::size_t>(bands * data->GetNumberOfCells());
  Side side{ suffix, bands, std::vector<double>(values), {}, {}, {} };
  if (vtkDataArray* replicates = arrayOf(data, replicatesName(suffix)))
  {
    const int components = replicates->GetNumberOfComponents();
    throwIf(components % bands != 0, leaf, ": the cell array ", replicatesName(suffix), " has ",
      components, " components, but ", irradianceName(suffix), " has ", bands,
      ": each replicate needs as many");
    side.replicates.emplace(values, bands, components / bands);
  }
  else if (arrayOf(data, errorName(suffix)))
  {
    side.errorBound.resize(values);
  }
  return side;
}

std::vector<Side> sidesOf(const std::string& leaf, vtkDataSet* data)
{
  std::vector<Side> sides;
  for (const char* suffix : sidesIn(data->GetCellData()))
  {
    sides.push_back(newSide(leaf, suffix, data));
  }
  return sides;
}

void begin(Leaf& leaf, vtkDataSet* data, double time)
{
  leaf.firstTime = time;
  leaf.sides = sidesOf(leaf.name, data);
  throwIf(leaf.sides.empty(), leaf.name, " has no cell array ", irradianceName(), ", or ",
    irradianceName("Front"), " and ", irradianceName("Back"), ", at time ", time,
    ": connect the output of vtkIrradianceFilter, or data that have such arrays");
}

void checkCells(const Leaf& leaf, vtkDataSet* data, double time)
{
  const vtkIdType cells = data->GetNumberOfCells();
  const vtkIdType before = leaf.geometry ? leaf.geometry->GetNumberOfCells() : cells;
  throwIf(before != cells, leaf.name, " has ", before, " cells at time ", leaf.time, ", but ",
    cells, " at time ", time, ": the exposure of a cell needs the same cells at all times");
}

void addSide(const std::string& leaf, Side& side, vtkDataSet* data, double time, double weight)
{
  const auto bands = static_cast<std::size_t>(side.bands);
  const auto array = [&](const std::string& name, std::size_t components) {
    return checkedValues(leaf, data, name, components, time);
  };
  const auto values = array(irradianceName(side.suffix), bands);
  const double* irradiance = values.get();
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
    throwIf(true, leaf, ", cell ", (bad - irradiance) / side.bands, ": ",
      irradianceName(side.suffix), " is ", *bad, " at time ", time);
  }
  if (side.replicates)
  {
    side.replicates->add(irradiance,
      array(replicatesName(side.suffix), bands * side.replicates->count()),
      array(photonName(side.suffix), bands).get(), weight);
  }
  if (!side.errorBound.empty())
  {
    const auto errors = array(errorName(side.suffix), bands);
    for (std::size_t i = 0; i < side.errorBound.size(); ++i)
    {
      side.errorBound[i] += weight * errors.get()[i];
    }
  }
  for (const std::string& group : groupsIn(data->GetCellData(), side.suffix))
  {
    const auto part = array(nameOfGroup(irradianceName(side.suffix), group), bands);
    std::vector<double>& sum = side.groups[group];
    sum.resize(side.exposure.size());
    std::transform(sum.begin(), sum.end(), part.get(), sum.begin(),
      [&](double before, double value) { return before + weight * value; });
  }
}

void endRuns(Leaf& leaf)
{
  for (Side& side : leaf.sides)
  {
    if (side.replicates)
    {
      side.replicates->endRuns();
    }
  }
}

/// Whether two sides have the same arrays.
bool isAlike(const Side& a, const Side& b)
{
  return a.suffix == b.suffix && a.exposure.size() == b.exposure.size() &&
    a.errorBound.size() == b.errorBound.size() &&
    a.replicates.has_value() == b.replicates.has_value() &&
    (!a.replicates || a.replicates->count() == b.replicates->count());
}

void appendSide(Side& side, const Side& next, bool isShared)
{
  const auto add = [](const std::vector<double>& more, std::vector<double>& sum) {
    std::transform(sum.begin(), sum.end(), more.begin(), sum.begin(), std::plus<>());
  };
  add(next.exposure, side.exposure);
  add(next.errorBound, side.errorBound);
  for (const auto& [group, more] : next.groups)
  {
    side.groups[group].resize(more.size());
    add(more, side.groups[group]);
  }
  if (side.replicates)
  {
    side.replicates->append(*next.replicates, isShared);
  }
}

/// Whether exposure is spread over the cells of a leaf: it is vtkPolyData with polygons or strips.
bool isSpreadable(vtkDataSet* leaf)
{
  auto* surface = vtkPolyData::SafeDownCast(leaf);
  return surface && surface->GetNumberOfPolys() + surface->GetNumberOfStrips() > 0;
}

/// The cells of such a leaf. Throws InputError for cells that are no polygons.
ExposedSurface surfaceOf(const Leaf& leaf, const CancelPoint& cancelPoint)
{
  ConvertedPolyData cells(1);
  vtkPolyData* surface = vtkPolyData::SafeDownCast(leaf.geometry);
  cells.reserve({ surface });
  convertPolyData(leaf.name, surface, {}, 0, cells, cancelPoint);
  return { std::move(cells.triangles), std::move(cells.material.cellOfTriangle),
    cells.material.numberOfCells };
}

/// Front and back are spread together, as surfaces that are turned over may go on as each other;
/// one of them alone would lose energy to the other, and stays as it is.
void spreadLeaf(Leaf& leaf, double photons, Execution& execution)
{
  const ExposedSurface surface = surfaceOf(leaf, cancelPointOf(execution, 0));
  std::vector<ExposedSide> halves;
  for (Side& side : leaf.sides)
  {
    const ExposedSide exposed{ &side.exposure, &side.replicates.value() };
    if (side.suffix.empty())
    {
      spreadExposure(surface, side.bands, { exposed }, photons, execution);
    }
    else
    {
      halves.push_back(exposed);
    }
  }
  if (halves.size() == 2 && halves[0].exposure->size() == halves[1].exposure->size() &&
    halves[0].replicates->count() == halves[1].replicates->count())
  {
    spreadExposure(surface, leaf.sides.back().bands, halves, photons, execution);
  }
}

/// The arrays that the output does not have; they would fill memory.
void removeInput(const Side& side, vtkDataSet* data)
{
  for (const std::string& name : { irradianceName(side.suffix), errorName(side.suffix),
         replicatesName(side.suffix), photonName(side.suffix), staleName(side.suffix) })
  {
    data->GetCellData()->RemoveArray(name.c_str());
  }
  for (const std::string& group : groupsIn(data->GetCellData(), side.suffix))
  {
    const std::string name = nameOfGroup(irradianceName(side.suffix), group);
    data->GetCellData()->RemoveArray(name.c_str());
    data->GetCellData()->RemoveArray(standardErrorName(name).c_str());
  }
}

void writeSide(const Side& side, vtkDataSet* data)
{
  const auto add = [&](const std::string& name, const auto& value) {
    const auto array =
      addArray<vtkDoubleArray>(data->GetCellData(), name, side.bands, data->GetNumberOfCells());
    for (std::size_t i = 0; i < side.exposure.size(); ++i)
    {
      array->SetValue(static_cast<vtkIdType>(i), value(i));
    }
  };
  removeInput(side, data);
  const std::string name = exposureName(side.suffix);
  add(name, [&](std::size_t i) { return side.exposure[i]; });
  if (side.replicates)
  {
    add(standardErrorName(name),
      [&](std::size_t i) { return side.replicates->standardError(i, side.exposure[i]); });
  }
  if (!side.errorBound.empty())
  {
    add(standardErrorName(name), [&](std::size_t i) { return side.errorBound[i]; });
  }
  for (const auto& [group, exposure] : side.groups)
  {
    add(nameOfGroup(name, group), [&part = exposure](std::size_t i) { return part[i]; });
  }
}

vtkSmartPointer<vtkDataSet> written(const Leaf& leaf, vtkDataSet* last)
{
  vtkDataSet* source = leaf.geometry ? leaf.geometry.Get() : last;
  if (!source)
  {
    return nullptr;
  }
  auto data = shallowCopyOf(source);
  data->GetInformation()->Remove(vtkDataObject::DATA_TIME_STEP());
  // A leaf that never had cells has arrays as the others, of no length.
  for (const Side& side : leaf.geometry ? leaf.sides : sidesOf(leaf.name, source))
  {
    writeSide(side, data);
  }
  data->GetCellData()->SetActiveScalars(exposureName().c_str());
  return data;
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
  throwIf(!isSame, "the structure of the input differs: it has ", leaves_.size(),
    " blocks at time ", firstTime_, " and ", leaves.size(), " blocks, or others, at time ", time,
    ". A part that is not there is an empty block");
}

void ExposureSums::add(const TimedData& input, double weight)
{
  const auto& [time, data] = input;
  const std::vector<LeafData> leaves = leavesOf(data);
  checkStructure(leaves, time);
  checkStale(data->GetFieldData(), time);
  for (std::size_t i = 0; i < leaves.size(); ++i)
  {
    Leaf& leaf = leaves_[i];
    vtkDataSet* cells = leaves[i].data;
    checkCellValues(leaves[i]);
    if (!cells || cells->GetNumberOfCells() == 0)
    {
      endRuns(leaf);
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
    leaf.geometry = shallowCopyOf(cells);
    for (const Side& side : leaf.sides)
    {
      removeInput(side, leaf.geometry);
    }
    leaf.time = time;
  }
  energies_.add(data->GetFieldData(), weight);
}

void ExposureSums::close()
{
  for (Leaf& leaf : leaves_)
  {
    endRuns(leaf);
  }
}

void ExposureSums::append(ExposureSums next)
{
  for (std::size_t i = 0; i < leaves_.size(); ++i)
  {
    Leaf &leaf = leaves_[i], &later = next.leaves_[i];
    if (!leaf.geometry)
    {
      leaf = std::move(later);
    }
    else if (later.geometry)
    {
      throwIf(!std::equal(leaf.sides.begin(), leaf.sides.end(), later.sides.begin(),
                later.sides.end(), isAlike),
        leaf.name, " has other cell arrays of irradiance or of its errors at time ",
        later.firstTime, " than before");
      for (std::size_t side = 0; side < leaf.sides.size(); ++side)
      {
        appendSide(leaf.sides[side], later.sides[side], leaf.time == later.firstTime);
      }
      leaf.geometry = later.geometry;
      leaf.time = later.time;
    }
  }
  energies_.append(next.energies_);
}

void ExposureSums::spread(double photons, Execution& execution)
{
  for (Leaf& leaf : leaves_)
  {
    const bool hasReplicates = std::all_of(leaf.sides.begin(), leaf.sides.end(),
      [](const Side& side) { return side.replicates.has_value(); });
    if (hasReplicates && isSpreadable(leaf.geometry))
    {
      spreadLeaf(leaf, photons, execution);
    }
  }
}

bool ExposureSums::haveCells() const
{
  return std::any_of(
    leaves_.begin(), leaves_.end(), [](const Leaf& leaf) { return leaf.geometry != nullptr; });
}

void ExposureSums::write(vtkDataObject* last, vtkDataObject* output) const
{
  const std::vector<LeafData> leaves = leavesOf(last);
  fillLeaves(last, output, [&](std::size_t i) { return written(leaves_[i], leaves[i].data); });
  output->GetInformation()->Remove(vtkDataObject::DATA_TIME_STEP());
  energies_.write(output->GetFieldData());
}

void ExposureSums::expectReplicates(vtkDataObject* data)
{
  for (const LeafData& leaf : leavesOf(data))
  {
    const bool isSpread = isSpreadable(leaf.data);
    for (const char* suffix :
      isSpread ? sidesIn(leaf.data->GetCellData()) : std::vector<const char*>{})
    {
      vtkDataArray* replicates = arrayOf(leaf.data, replicatesName(suffix));
      throwIf(!replicates ||
          replicates->GetNumberOfComponents() <
            2 * arrayOf(leaf.data, irradianceName(suffix))->GetNumberOfComponents(),
        leaf.name, " has no replicates of ", irradianceName(suffix),
        ", by which NumberOfSpreadPhotons counts its photons: switch ComputeStandardError of "
        "vtkIrradianceFilter on, or set NumberOfSpreadPhotons to 0; data from files have none");
    }
  }
}

}
