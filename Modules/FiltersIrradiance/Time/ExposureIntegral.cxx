// SPDX-License-Identifier: BSD-3-Clause
#include "Time/ExposureIntegral.h"

#include "Data/ArrayNames.h"
#include "Data/LeafData.h"
#include "Data/NamedArray.h"
#include "Exposure/AdaptiveTrapezoids.h"
#include "Exposure/ExposureNode.h"
#include "Exposure/IntegrationTimes.h"
#include "Geometry/Vector.h"
#include "Input/PartCells.h"
#include "Progress/InputError.h"

#include "vtkCellData.h"
#include "vtkCellSizeFilter.h"
#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkTriangle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace irradiance
{

namespace
{

class GivenTimesIntegral : public ExposureIntegral
{
public:
  explicit GivenTimesIntegral(std::vector<double> times) { times_ = std::move(times); }

  bool isDone() const override { return next_ == times_.size(); }

  std::vector<double> nextTimes(std::size_t most) const override
  {
    const std::size_t end = std::min(next_ + most, times_.size());
    return { times_.begin() + static_cast<std::ptrdiff_t>(next_),
      times_.begin() + static_cast<std::ptrdiff_t>(end) };
  }

  void take(vtkDataObject* data) override
  {
    const double time = times_[next_];
    const double before = next_ == 0 ? time : times_[next_ - 1];
    const double after = next_ + 1 == times_.size() ? time : times_[next_ + 1];
    sums_.add({ time, data }, trapezoidWeight(before, after));
    last_ = data;
    ++next_;
  }

  double progress() const override
  {
    return static_cast<double>(next_) / static_cast<double>(times_.size());
  }

private:
  std::size_t next_ = 0;
};

/// That of a polygon in one plane, convex or not. vtkPolygon's has float's rounding in VTK 9.3.
double polygonArea(vtkPoints* points, vtkIdType count, const vtkIdType* ids)
{
  const auto corner = [&](vtkIdType i) {
    Vector3 point;
    points->GetPoint(ids[i], point.data());
    return point;
  };
  Vector3 twice = Vector3::Zero();
  for (vtkIdType i = 2; i < count; ++i)
  {
    twice += (corner(i - 1) - corner(0)).cross(corner(i) - corner(0));
  }
  return twice.norm() / 2;
}

double stripArea(vtkPoints* points, vtkIdType count, const vtkIdType* ids)
{
  double area = 0;
  for (vtkIdType i = 2; i < count; ++i)
  {
    double corners[3][3];
    for (vtkIdType corner = 0; corner < 3; ++corner)
    {
      points->GetPoint(ids[i - 2 + corner], corners[corner]);
    }
    area += vtkTriangle::TriangleArea(corners[0], corners[1], corners[2]);
  }
  return area;
}

/// vtkPolyData cannot give its cells one by one, and crashes in vtkCellSizeFilter, if one of them
/// has fewer points than its type needs.
std::vector<double> polyDataAreas(vtkPolyData* data)
{
  std::vector<double> areas(
    static_cast<std::size_t>(data->GetNumberOfVerts() + data->GetNumberOfLines()));
  const auto addAll = [&](vtkCellArray* cells, const auto& areaOf) {
    forEachCell(cells, [&](vtkIdType count, const vtkIdType* ids) {
      areas.push_back(count < 3 ? 0 : areaOf(data->GetPoints(), count, ids));
    });
  };
  addAll(data->GetPolys(), polygonArea);
  addAll(data->GetStrips(), stripArea);
  return areas;
}

std::vector<double> dataSetAreas(vtkDataSet* data)
{
  vtkNew<vtkCellSizeFilter> sizes;
  sizes->SetInputData(data);
  sizes->ComputeVertexCountOff();
  sizes->ComputeLengthOff();
  sizes->ComputeVolumeOff();
  sizes->Update();
  vtkDataArray* array =
    vtkDataSet::SafeDownCast(sizes->GetOutput())->GetCellData()->GetArray("Area");
  const SharedValues areas = valuesOf(array);
  return { areas.get(), areas.get() + data->GetNumberOfCells() };
}

/// The areas of all cells, in the squared unit of the points; 0 for cells that have none.
std::vector<double> cellAreas(vtkDataSet* data)
{
  auto* polyData = vtkPolyData::SafeDownCast(data);
  std::vector<double> areas = polyData ? polyDataAreas(polyData) : dataSetAreas(data);
  for (double& area : areas)
  {
    area = std::isfinite(area) ? std::abs(area) : 0;
  }
  return areas;
}

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

class ErrorControlledIntegral : public ExposureIntegral
{
public:
  ErrorControlledIntegral(std::vector<double> firstTimes, double tolerance, int mostIntervals)
    : lastTime_(firstTimes.back())
    , tolerance_(tolerance)
    , mostIntervals_(mostIntervals)
    , rule_(std::move(firstTimes), tolerance, static_cast<std::size_t>(mostIntervals))
  {
  }

  bool isDone() const override { return rule_.isDone(); }
  std::vector<double> nextTimes(std::size_t most) const override { return rule_.nextTimes(most); }
  double progress() const override { return rule_.progress(); }

  void take(vtkDataObject* data) override
  {
    const TimedData input{ nextTimes(1).front(), snapshotOf(data) };
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
      relativeError_ = rule_.halving().relativeError();
      relativeNoise_ = rule_.halving().relativeNoise();
      shortfall_ = relativeError_ <= tolerance_ ? "" : textOfShortfall();
    }
  }

private:
  /// The input at one time.
  struct Sample : TimedData
  {
    ExposureNode node;
  };

  std::string textOfShortfall() const
  {
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
    return joined("RelativeTolerance ", tolerance_,
      " is not reached with MaximumNumberOfTimeSteps ", mostIntervals_,
      ". Estimated errors of the integration over time: ", blocks);
  }

  double lastTime_, tolerance_;
  int mostIntervals_;
  AdaptiveTrapezoids<Sample, ExposureSums> rule_;
  ExposureSums checks_; ///< of all that is taken, with weights of 0: whether it fits together
  std::vector<ExposureBlock> blocks_;
};

}

std::unique_ptr<ExposureIntegral> integralOver(std::vector<double> times)
{
  return std::make_unique<GivenTimesIntegral>(std::move(times));
}

std::unique_ptr<ExposureIntegral> errorControlledIntegral(
  std::vector<double> firstTimes, double tolerance, int mostIntervals)
{
  return std::make_unique<ErrorControlledIntegral>(std::move(firstTimes), tolerance, mostIntervals);
}

}
