// SPDX-License-Identifier: BSD-3-Clause
#include "ErrorControlledIntegral.h"

#include "InputError.h"

#include "vtkCellData.h"
#include "vtkCellSizeFilter.h"
#include "vtkDataSet.h"
#include "vtkNew.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace irradiance
{

namespace
{

std::vector<double> areasOf(vtkDataSet* data)
{
  vtkNew<vtkCellSizeFilter> sizes;
  sizes->SetInputData(data);
  sizes->ComputeVertexCountOff();
  sizes->ComputeLengthOff();
  sizes->ComputeVolumeOff();
  sizes->Update();
  vtkDataArray* areas =
    vtkDataSet::SafeDownCast(sizes->GetOutput())->GetCellData()->GetArray("Area");
  std::vector<double> values(static_cast<std::size_t>(data->GetNumberOfCells()));
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const double area = areas->GetComponent(static_cast<vtkIdType>(i), 0);
    values[i] = std::isfinite(area) ? std::abs(area) : 0;
  }
  return values;
}

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

}

ErrorControlledIntegral::ErrorControlledIntegral(const Config& config)
  : config_(config)
  , firstTimes_(uniformTimes(config.span, config.firstIntervals))
{
}

double ErrorControlledIntegral::nextTime() const
{
  return first_.size() < firstTimes_.size() && right_.empty()
    ? firstTimes_[first_.size()]
    : left_.time + (right_.back().time - left_.time) / 2;
}

double ErrorControlledIntegral::progress() const
{
  constexpr double firstShare = 0.25;
  const auto part = [](std::size_t a, std::size_t b) {
    return static_cast<double>(a) / static_cast<double>(b);
  };
  return right_.empty() && !isDone_ ? firstShare * part(first_.size(), firstTimes_.size())
                                    : firstShare +
      (1 - firstShare) * (left_.time - config_.span.start) /
        (config_.span.end - config_.span.start);
}

ErrorControlledIntegral::LeafNode ErrorControlledIntegral::leafNodeOf(
  Leaf& leaf, vtkDataSet* data) const
{
  LeafNode node;
  if (!data || data->GetNumberOfCells() == 0)
  {
    return node;
  }
  if (leaf.areas.empty())
  {
    leaf.areas = areasOf(data);
  }
  for (const char* name : { "Irradiance", "IrradianceFront", "IrradianceBack" })
  {
    if (vtkDataArray* array = data->GetCellData()->GetArray(name))
    {
      node.irradiances.push_back(asDouble(array));
      const auto bands = static_cast<std::size_t>(array->GetNumberOfComponents());
      const double* irradiance = node.irradiances.back()->GetPointer(0);
      for (std::size_t i = 0; i < leaf.areas.size() * bands; ++i)
      {
        node.power += leaf.areas[i / bands] * irradiance[i];
      }
    }
  }
  return node;
}

void ErrorControlledIntegral::take(vtkDataObject* data)
{
  Node node{ nextTime(), snapshotOf(data), {} };
  checks_.add(node.data, node.time, 0);
  const std::vector<LeafData> leaves = leavesOf(node.data);
  leaves_.resize(leaves.size());
  for (std::size_t i = 0; i < leaves.size(); ++i)
  {
    leaves_[i].name = leaves[i].name;
    node.leaves.push_back(leafNodeOf(leaves_[i], leaves[i].data));
  }
  if (!right_.empty())
  {
    tryInterval(node);
    return;
  }
  first_.push_back(std::move(node));
  if (first_.size() == firstTimes_.size())
  {
    begin();
  }
}

/// All first times are known, and with them about how much each leaf receives.
void ErrorControlledIntegral::begin()
{
  for (std::size_t i = 1; i < first_.size(); ++i)
  {
    const Node &a = first_[i - 1], &b = first_[i];
    for (std::size_t leaf = 0; leaf < leaves_.size(); ++leaf)
    {
      leaves_[leaf].energy +=
        (b.time - a.time) * 0.5 * (a.leaves[leaf].power + b.leaves[leaf].power);
    }
  }
  last_ = first_.back().data;
  left_ = settled_ = first_.front();
  before_ = settled_.time;
  times_ = { settled_.time };
  right_.assign(first_.rbegin(), first_.rend() - 1);
  first_.clear();
}

double ErrorControlledIntegral::difference(std::size_t leaf, const Node& middle) const
{
  const double length = right_.back().time - left_.time;
  const std::vector<double>& areas = leaves_[leaf].areas;
  const std::array<const LeafNode*, 3> nodes{ &left_.leaves[leaf], &middle.leaves[leaf],
    &right_.back().leaves[leaf] };
  const std::size_t sides = std::max(
    { nodes[0]->irradiances.size(), nodes[1]->irradiances.size(), nodes[2]->irradiances.size() });
  double sum = 0;
  for (std::size_t side = 0; side < sides; ++side)
  {
    std::array<const double*, 3> values{}; // null: not there, 0
    std::size_t bands = 1;
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
      if (!nodes[i]->irradiances.empty())
      {
        values[i] = nodes[i]->irradiances[side]->GetPointer(0);
        bands = static_cast<std::size_t>(nodes[i]->irradiances[side]->GetNumberOfComponents());
      }
    }
    for (std::size_t i = 0; i < areas.size() * bands; ++i)
    {
      const auto irradiance = [&](
                                std::size_t node) { return values[node] ? values[node][i] : 0.0; };
      const double off = 0.5 * irradiance(1) - 0.25 * (irradiance(0) + irradiance(2));
      sum += areas[i / bands] * std::abs(length * off);
    }
  }
  return sum;
}

bool ErrorControlledIntegral::isAllowed(const std::vector<double>& errors) const
{
  const double span = config_.span.end - config_.span.start;
  const double length = right_.back().time - left_.time;
  const double passed = right_.back().time - config_.span.start;
  for (std::size_t i = 0; i < leaves_.size(); ++i)
  {
    const double tolerated = config_.tolerance * leaves_[i].energy;
    const double share = 0.5 * tolerated * length / span;
    const double left = 0.5 * tolerated * (1 + passed / span) - leaves_[i].error;
    if (errors[i] > std::max(share, 0.25 * left))
    {
      return false;
    }
  }
  return true;
}

bool ErrorControlledIntegral::canHalve(const Node& middle) const
{
  // All intervals that are left count twice, as their halves are what is used.
  const std::size_t intervals = times_.size() - 1 + 2 * (right_.size() + 1);
  return intervals <= static_cast<std::size_t>(config_.mostIntervals) && left_.time < middle.time &&
    middle.time < right_.back().time;
}

void ErrorControlledIntegral::tryInterval(const Node& middle)
{
  const double length = right_.back().time - left_.time;
  std::vector<double> errors;
  for (std::size_t i = 0; i < leaves_.size(); ++i)
  {
    errors.push_back(difference(i, middle));
    leaves_[i].energy += length *
      (0.5 * middle.leaves[i].power -
        0.25 * (left_.leaves[i].power + right_.back().leaves[i].power));
  }
  if (isAllowed(errors))
  {
    accept(middle, errors);
  }
  else if (canHalve(middle))
  {
    right_.push_back(middle);
  }
  else
  {
    isCapped_ = true;
    accept(middle, errors);
  }
}

void ErrorControlledIntegral::accept(const Node& middle, const std::vector<double>& errors)
{
  for (std::size_t i = 0; i < leaves_.size(); ++i)
  {
    leaves_[i].error += errors[i];
  }
  settle(middle);
  settle(right_.back());
  left_ = std::move(right_.back());
  right_.pop_back();
  if (right_.empty())
  {
    sums_.add(settled_.data, settled_.time, trapezoidWeight(before_, settled_.time));
    isDone_ = true;
  }
}

void ErrorControlledIntegral::settle(const Node& node)
{
  sums_.add(settled_.data, settled_.time, trapezoidWeight(before_, node.time));
  before_ = settled_.time;
  settled_ = node;
  times_.push_back(node.time);
}

double ErrorControlledIntegral::relativeError() const
{
  double worst = 0;
  for (const Leaf& leaf : leaves_)
  {
    worst = leaf.error > 0 ? std::max(worst, leaf.error / leaf.energy) : worst;
  }
  return worst;
}

std::string ErrorControlledIntegral::shortfall() const
{
  if (!isCapped_ || relativeError() <= config_.tolerance)
  {
    return "";
  }
  std::string blocks;
  for (const Leaf& leaf : leaves_)
  {
    if (leaf.error > config_.tolerance * leaf.energy)
    {
      blocks += (blocks.empty() ? "" : ", ") + leaf.name + ": " + text(leaf.error / leaf.energy);
    }
  }
  return "RelativeTolerance " + text(config_.tolerance) +
    " is not reached with MaximumNumberOfTimeSteps " + std::to_string(config_.mostIntervals) +
    ". Estimated errors of the integration over time: " + blocks;
}

}
