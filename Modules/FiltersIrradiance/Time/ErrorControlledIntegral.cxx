// SPDX-License-Identifier: BSD-3-Clause
#include "Time/ErrorControlledIntegral.h"

#include "Data/ArrayNames.h"
#include "Data/CellAreas.h"
#include "Data/CellValues.h"
#include "Data/LeafData.h"
#include "Progress/InputError.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"

#include <array>
#include <utility>

namespace irradiance
{

namespace
{

using Sides = std::vector<ExposureNode::Side>;

Sides sidesOf(vtkCellData* cells)
{
  Sides sides;
  for (const std::string suffix : kSideSuffixes)
  {
    if (vtkDataArray* irradiance = cells->GetArray(irradianceName(suffix).c_str()))
    {
      sides.push_back({ static_cast<std::size_t>(irradiance->GetNumberOfComponents()),
        valuesOf(irradiance), valuesOf(cells->GetArray(photonName(suffix).c_str())) });
    }
  }
  return sides;
}

/// Measures the areas of blocks that have cells for the first time.
ExposureNode nodeOf(const TimedData& input, std::vector<ExposureBlock>& blocks)
{
  const std::vector<LeafData> leaves = leavesOf(input.data);
  std::vector<Sides> sides(leaves.size());
  blocks.resize(leaves.size());
  for (std::size_t i = 0; i < leaves.size(); ++i)
  {
    blocks[i].name = leaves[i].name;
    vtkDataSet* cells = leaves[i].data;
    if (cells && cells->GetNumberOfCells() > 0)
    {
      blocks[i].areas = blocks[i].areas.empty() ? cellAreas(cells) : std::move(blocks[i].areas);
      sides[i] = sidesOf(cells->GetCellData());
    }
  }
  return { input.time, sides, blocks };
}

}

ErrorControlledIntegral::ErrorControlledIntegral(
  std::vector<double> firstTimes, double tolerance, int mostIntervals)
  : lastTime_(firstTimes.back())
  , tolerance_(tolerance)
  , mostIntervals_(mostIntervals)
  , rule_(std::move(firstTimes), tolerance, static_cast<std::size_t>(mostIntervals))
{
}

void ErrorControlledIntegral::take(vtkDataObject* data)
{
  const TimedData input{ nextTime(), snapshotOf(data) };
  checks_.add(input, 0);
  checks_.close();
  last_ = input.time == lastTime_ ? input.data : last_;
  rule_.take({ input, nodeOf(input, blocks_) }, [&](const std::array<const Sample*, 3>& samples) {
    return ExposureNode::measure(
      { &samples[0]->node, &samples[1]->node, &samples[2]->node }, blocks_);
  });
  if (rule_.isDone())
  {
    sums_ = rule_.takeSums();
    times_ = rule_.times();
  }
}

std::string ErrorControlledIntegral::shortfall() const
{
  if (relativeError() <= tolerance_)
  {
    return "";
  }
  const std::vector<IntervalMeasure> totals = rule_.halving().totals();
  std::string blocks;
  for (std::size_t i = 0; i < totals.size(); ++i)
  {
    if (totals[i].error > tolerance_ * totals[i].energy)
    {
      blocks += (blocks.empty() ? "" : ", ") + blocks_[i].name + ": " +
        text(totals[i].error / totals[i].energy);
    }
  }
  return "RelativeTolerance " + text(tolerance_) +
    " is not reached with MaximumNumberOfTimeSteps " + std::to_string(mostIntervals_) +
    ". Estimated errors of the integration over time: " + blocks;
}

}
