// SPDX-License-Identifier: BSD-3-Clause
#include "Time/ExposureNode.h"

#include "Data/CellAreas.h"
#include "Data/LeafData.h"
#include "Pipeline/ReplicateArrays.h"

#include "vtkCellData.h"
#include "vtkDataSet.h"

#include <algorithm>
#include <utility>

namespace irradiance
{

namespace
{

vtkSmartPointer<vtkDoubleArray> doublesOf(vtkDataSet* data, const std::string& name)
{
  vtkDataArray* array = data->GetCellData()->GetArray(name.c_str());
  vtkSmartPointer<vtkDoubleArray> values = vtkDoubleArray::SafeDownCast(array);
  if (array && !values)
  {
    values = vtkSmartPointer<vtkDoubleArray>::New();
    values->DeepCopy(array);
  }
  return values;
}

/// How two trapezoids between three times differ from one: a weighted sum of the values at these times.
std::array<double, 3> differenceWeights(double start, double middle, double end)
{
  const double length = end - start, before = middle - start, after = end - middle;
  // As large as the error can be if something appears anywhere between the times.
  const double scale = 0.5 * length * std::max(before / after, after / before);
  return { -scale * after / length, scale, -scale * before / length };
}

}

ExposureNode::ExposureNode(double time, vtkDataObject* data, std::vector<ExposureBlock>& blocks)
  : time_(time)
  , data_(data)
{
  const std::vector<LeafData> leaves = leavesOf(data);
  blocks.resize(leaves.size());
  leaves_.resize(leaves.size());
  for (std::size_t i = 0; i < leaves.size(); ++i)
  {
    blocks[i].name = leaves[i].name;
    vtkDataSet* cells = leaves[i].data;
    if (!cells || cells->GetNumberOfCells() == 0)
    {
      continue;
    }
    if (blocks[i].areas.empty())
    {
      blocks[i].areas = cellAreas(cells);
    }
    for (const char* suffix : { "", "Front", "Back" })
    {
      if (const auto irradiance = doublesOf(cells, std::string("Irradiance") + suffix))
      {
        leaves_[i].sides.push_back({ irradiance, doublesOf(cells, photonName(suffix)) });
        leaves_[i].power += powerOf(leaves_[i].sides.back(), blocks[i].areas);
      }
    }
  }
}

double ExposureNode::powerOf(const Side& side, const std::vector<double>& areas)
{
  const auto bands = static_cast<std::size_t>(side.irradiance->GetNumberOfComponents());
  double power = 0;
  for (std::size_t i = 0; i < areas.size() * bands; ++i)
  {
    power += areas[i / bands] * side.irradiance->GetPointer(0)[i];
  }
  return power;
}

std::vector<IntervalMeasure> ExposureNode::measure(
  const Three& nodes, const std::vector<ExposureBlock>& blocks)
{
  const double start = nodes[0]->time_, middle = nodes[1]->time_, end = nodes[2]->time_;
  const std::array<double, 3> weights = differenceWeights(start, middle, end);
  const std::array<double, 3> parts{ middle - start, end - start, end - middle };
  std::vector<IntervalMeasure> measures(blocks.size());
  for (std::size_t leaf = 0; leaf < blocks.size(); ++leaf)
  {
    std::size_t sides = 0;
    for (std::size_t node = 0; node < nodes.size(); ++node)
    {
      measures[leaf].energy += 0.5 * parts[node] * nodes[node]->leaves_[leaf].power;
      sides = std::max(sides, nodes[node]->leaves_[leaf].sides.size());
    }
    for (std::size_t side = 0; side < sides; ++side)
    {
      const NoisyDifference difference =
        differenceOf(nodes, weights, leaf, side, blocks[leaf].areas);
      measures[leaf].error += difference.signal;
      measures[leaf].noise += difference.noise;
    }
  }
  return measures;
}

NoisyDifference ExposureNode::differenceOf(const Three& nodes, const std::array<double, 3>& weights,
  std::size_t leaf, std::size_t side, const std::vector<double>& areas)
{
  std::vector<double> differences, variances;
  for (std::size_t node = 0; node < nodes.size(); ++node)
  {
    if (side >= nodes[node]->leaves_[leaf].sides.size())
    {
      continue; // no cells, so no irradiance
    }
    const Side& values = nodes[node]->leaves_[leaf].sides[side];
    const auto bands = static_cast<std::size_t>(values.irradiance->GetNumberOfComponents());
    const double* irradiance = values.irradiance->GetPointer(0);
    const double* photon = values.photon ? values.photon->GetPointer(0) : nullptr;
    differences.resize(areas.size() * bands);
    variances.resize(areas.size() * bands);
    for (std::size_t i = 0; i < areas.size() * bands; ++i)
    {
      const std::size_t value =
        i % bands * areas.size() + i / bands; // bands apart, as cells are neighbours
      const double weight = weights[node] * areas[i / bands];
      differences[value] += weight * irradiance[i];
      // n photons vary by sqrt(n).
      variances[value] += photon ? weight * weight * irradiance[i] * photon[i] : 0;
    }
  }
  return splitDifference(std::move(differences), std::move(variances));
}

}
