// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ErrorObserver.h"
#include "EventObserver.h"
#include "OutputBits.h"
#include "PartOverTime.h"
#include "TestScenes.h"

#include "vtkRadiantExposureFilter.h"

#include <gtest/gtest.h>

#include <algorithm>

/// What the tests of vtkRadiantExposureFilter share.
namespace ExposureScenes
{

using namespace TestScenes;

using Exposure = vtkSmartPointer<vtkRadiantExposureFilter>;

const std::vector<double> kTimes{ 0, 0.25, 0.5, 1, 1.5 }; // intervals differ

/// Integrates over the steps of the input.
inline Exposure MakeExposure(vtkAlgorithm* input)
{
  auto exposure = Exposure::New();
  exposure->SetInputConnection(input->GetOutputPort());
  exposure->SetIntegrationModeToTimeSteps();
  return exposure;
}

inline Exposure MakeErrorControlled(vtkAlgorithm* input, int firstSteps, double tolerance)
{
  auto exposure = MakeExposure(input);
  exposure->SetIntegrationModeToErrorControlled();
  exposure->SetNumberOfTimeSteps(firstSteps);
  exposure->SetRelativeTolerance(tolerance);
  return exposure;
}

/// A ball that walks through the small room, and the filter behind it.
struct WalkThrough
{
  explicit WalkThrough(vtkIdType walks)
    : Walks(walks)
    , Ball(PartOverTime::Make(MakeBall(0.3, 6), kTimes,
        [](vtkPolyData* ball, double time) { MoveTo(ball, PositionAt(time)); }))
    , Irradiance(MakeFilter(MakeEmptyRoom(), walks))
  {
    this->Irradiance->AddInputConnection(1, this->Ball->GetOutputPort());
  }

  static Vector PositionAt(double time) { return { 0.6 + time, 1.2, 1 + 0.5 * time }; }
  /// What a new filter finds at a time.
  vtkSmartPointer<vtkIrradianceFilter> FreshAt(double time) const
  {
    Scene scene = MakeEmptyRoom();
    scene.Moving.push_back(MakeMoving(this->Ball->Model, PositionAt(time)));
    auto fresh = MakeFilter(scene, this->Walks);
    fresh->Update();
    return fresh;
  }

  vtkIdType Walks;
  vtkSmartPointer<PartOverTime> Ball;
  vtkSmartPointer<vtkIrradianceFilter> Irradiance;
};

inline vtkMultiBlockDataSet* BlocksOf(vtkRadiantExposureFilter* exposure)
{
  return vtkMultiBlockDataSet::SafeDownCast(exposure->GetOutputDataObject(0));
}

inline vtkDataArray* ExposureOf(
  vtkRadiantExposureFilter* exposure, unsigned int port, unsigned int i)
{
  return OutputOf(BlocksOf(exposure), port, i)->GetCellData()->GetArray("RadiantExposure");
}

inline double FieldOf(vtkRadiantExposureFilter* exposure, const char* name)
{
  return exposure->GetOutputDataObject(0)->GetFieldData()->GetArray(name)->GetComponent(0, 0);
}

inline void AddTimes(double weight, vtkDataArray* values, std::vector<double>& sum)
{
  sum.resize(static_cast<std::size_t>(values->GetNumberOfTuples()));
  for (std::size_t cell = 0; cell < sum.size(); ++cell)
  {
    sum[cell] += weight * values->GetComponent(static_cast<vtkIdType>(cell), 0);
  }
}

/// The law: the bits of a sum over new filters, in the order of time.
inline void ExpectSumOverFresh(
  vtkRadiantExposureFilter* exposure, const WalkThrough& scene, const std::vector<double>& times)
{
  std::array<std::vector<double>, 2> sums;
  for (std::size_t i = 0; i < times.size(); ++i)
  {
    const double before = times[i == 0 ? i : i - 1],
                 after = times[std::min(i + 1, times.size() - 1)];
    const auto fresh = scene.FreshAt(times[i]);
    for (const unsigned int port : { 0u, 1u })
    {
      AddTimes(0.5 * (after - before), IrradianceOf(fresh, port, 0), sums[port]);
    }
  }
  for (const unsigned int port : { 0u, 1u })
  {
    ASSERT_GT(sums[port].at(0), 0);
    EXPECT_EQ(ValuesOf(ExposureOf(exposure, port, 0)), sums[port]);
  }
}

/// A square of one cell with an irradiance that a function of time gives.
inline vtkSmartPointer<PartOverTime> MakeLitSquare(
  const std::vector<double>& times, const std::function<double(double)>& irradiance)
{
  return PartOverTime::Make(MakeRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1), times,
    [irradiance](vtkPolyData* square, double time) {
      SetCellValues(square, "Irradiance", { irradiance(time) });
    });
}

inline double SquareExposure(vtkRadiantExposureFilter* exposure)
{
  auto* square = vtkPolyData::SafeDownCast(exposure->GetOutputDataObject(0));
  return square->GetCellData()->GetArray("RadiantExposure")->GetComponent(0, 0);
}

/// The only error of an update, after which the output is empty.
inline std::string ErrorOf(vtkRadiantExposureFilter* exposure)
{
  const auto observer = ErrorObserver::Watch(exposure);
  exposure->Modified();
  exposure->Update();
  EXPECT_EQ(observer->Errors.size(), 1u);
  vtkDataObject* output = exposure->GetOutputDataObject(0);
  EXPECT_EQ(output->GetNumberOfElements(vtkDataObject::CELL), 0);
  EXPECT_EQ(output->GetFieldData()->GetNumberOfArrays(), 0);
  exposure->RemoveObserver(observer);
  exposure->GetExecutive()->RemoveObserver(observer);
  return observer->Errors.empty() ? "" : observer->Errors[0];
}

inline std::vector<double> IntegrationTimesOf(vtkRadiantExposureFilter* exposure)
{
  return ValuesOf(exposure->GetOutputDataObject(0)->GetFieldData()->GetArray("IntegrationTimes"));
}

}
