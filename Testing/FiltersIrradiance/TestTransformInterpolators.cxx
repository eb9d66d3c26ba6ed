// SPDX-License-Identifier: BSD-3-Clause
// Poses by transform interpolators, at the requested time.

#include "ErrorObserver.h"
#include "OutputBits.h"
#include "TestScenes.h"

#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTransformInterpolator.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace TestScenes;

namespace
{

constexpr vtkIdType Walks = 1000;

/// Straight on from x = 0.5 at time 2 to x = 2.5 at time 6.
vtkSmartPointer<vtkTransformInterpolator> MakeRide()
{
  auto ride = vtkSmartPointer<vtkTransformInterpolator>::New();
  ride->SetInterpolationTypeToLinear();
  for (const double time : { 2.0, 6.0 })
  {
    vtkNew<vtkTransform> pose;
    pose->Translate(0.5 * time - 0.5, 1.5, 1);
    ride->AddTransform(time, pose);
  }
  return ride;
}

Scene MakeStill()
{
  return { { MakeRoom(3, 2), MakeLamp({ 1.5, 1.5, 2.9 }, 0.5, { 100 }) }, {} };
}

vtkSmartPointer<vtkIrradianceFilter> MakeFilter(vtkTransformInterpolator* ride)
{
  auto filter = TestScenes::MakeFilter(MakeStill(), Walks);
  filter->AddInputDataObject(1, MakeBall(0.3, 6));
  filter->SetDynamicTransformInterpolator(0, ride);
  return filter;
}

/// What a filter gives with the ball at (x, 1.5, 1).
OutputBits BitsAt(double x)
{
  Scene scene = MakeStill();
  scene.Moving.push_back(MakeMoving(MakeBall(0.3, 6), { x, 1.5, 1 }));
  const auto filter = TestScenes::MakeFilter(scene, Walks);
  filter->Update();
  return OutputBits(filter);
}

vtkSmartPointer<vtkTransformInterpolator> WithKeys(const std::vector<double>& degrees)
{
  auto interpolator = vtkSmartPointer<vtkTransformInterpolator>::New();
  for (std::size_t i = 0; i < degrees.size(); ++i)
  {
    vtkNew<vtkTransform> pose;
    pose->Translate(1.5, 1.5, 1);
    pose->RotateZ(degrees[i]);
    interpolator->AddTransform(static_cast<double>(i), pose);
  }
  return interpolator;
}

}

TEST(TransformInterpolators, AreEvaluatedAtTheRequestedTime)
{
  auto filter = MakeFilter(MakeRide());
  filter->Update(); // without a time: the first key
  EXPECT_TRUE(IsSame(OutputBits(filter), BitsAt(0.5)));
  for (const double time : { 6.0, 3.0, 2.0, 4.5, 3.0 })
  {
    filter->UpdateTimeStep(time);
    EXPECT_TRUE(IsSame(OutputBits(filter), BitsAt(0.5 * time - 0.5))) << "time " << time;
    EXPECT_EQ(Field(filter, "ShootSeconds"), 0);
  }
}

TEST(TransformInterpolators, AddTheirKeysToTheRangeOfTimes)
{
  auto filter = MakeFilter(MakeRide());
  filter->UpdateInformation();
  vtkInformation* info = filter->GetOutputInformation(0);
  const double* range = info->Get(vtkStreamingDemandDrivenPipeline::TIME_RANGE());
  ASSERT_NE(range, nullptr);
  EXPECT_EQ(range[0], 2);
  EXPECT_EQ(range[1], 6);
  EXPECT_FALSE(info->Has(vtkStreamingDemandDrivenPipeline::TIME_STEPS()));
  filter->RemoveAllDynamicTransforms();
  filter->UpdateInformation();
  EXPECT_FALSE(info->Has(vtkStreamingDemandDrivenPipeline::TIME_RANGE()));
}

TEST(TransformInterpolators, ReplaceTransformsAndAreReplacedByThem)
{
  auto ride = MakeRide();
  auto filter = MakeFilter(ride);
  vtkNew<vtkTransform> pose;
  pose->Translate(1, 1.5, 1);
  EXPECT_EQ(filter->GetDynamicTransform(0), nullptr);
  filter->SetDynamicTransform(0, pose);
  EXPECT_EQ(filter->GetDynamicTransform(0), pose);
  EXPECT_EQ(filter->GetDynamicTransformInterpolator(0), nullptr);
  filter->UpdateTimeStep(6);
  EXPECT_TRUE(IsSame(OutputBits(filter), BitsAt(1)));
  filter->SetDynamicTransformInterpolator(0, ride);
  EXPECT_EQ(filter->GetDynamicTransform(0), nullptr);
  EXPECT_EQ(filter->GetDynamicTransformInterpolator(0), ride);
  filter->UpdateTimeStep(6);
  EXPECT_TRUE(IsSame(OutputBits(filter), BitsAt(2.5)));
  EXPECT_EQ(filter->GetDynamicTransform(0), nullptr); // nor after an evaluation
  filter->SetDynamicTransform(0, nullptr);
  EXPECT_EQ(filter->GetDynamicTransformInterpolator(0), nullptr);
}

TEST(TransformInterpolators, ChangeTheFilterOnlyWhenTheyChange)
{
  auto ride = MakeRide();
  auto filter = MakeFilter(ride);
  filter->UpdateTimeStep(3);
  const vtkMTimeType before = filter->GetOutput()->GetUpdateTime();
  filter->UpdateTimeStep(3); // evaluation alone is no reason to execute again
  EXPECT_EQ(filter->GetOutput()->GetUpdateTime(), before);
  vtkNew<vtkTransform> end;
  end->Translate(3 - 0.125, 1.5, 1);
  ride->AddTransform(7, end); // VTK 9.1 does not call this a modification
  filter->UpdateTimeStep(7);
  EXPECT_TRUE(IsSame(OutputBits(filter), BitsAt(3 - 0.125)));
  vtkNew<vtkTransform> middle;
  middle->Translate(2, 1.5, 1);
  ride->AddTransform(3, middle);
  filter->UpdateTimeStep(3);
  EXPECT_TRUE(IsSame(OutputBits(filter), BitsAt(2)));
}

TEST(TransformInterpolators, AreRefusedIfTheyCannotBeEvaluated)
{
  const auto errorOf = [](vtkTransformInterpolator* interpolator, double time, int connection) {
    auto filter = MakeFilter(nullptr);
    filter->SetDynamicTransformInterpolator(connection, interpolator);
    filter->UpdateInformation();
    filter->GetOutputInformation(0)->Set(
      vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP(), time);
    const std::string error = OnlyErrorOf(filter);
    filter->RemoveAllDynamicTransforms(); // it stays usable
    filter->Update();
    EXPECT_EQ(filter->GetOutput()->GetNumberOfBlocks(), 2u);
    return error;
  };
  const auto has = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  has(errorOf(WithKeys({}), 0, 0),
    "input port 1, connection 0: the transform interpolator has 0 keys");
  has(errorOf(WithKeys({ 0 }), 0, 0), "has 1 key;");
  has(errorOf(MakeRide(), 6.5, 0), "keys from 2 to 6, and the time 6.5");
  has(errorOf(MakeRide(), 1.5, 0), "keys from 2 to 6, and the time 1.5");
  has(errorOf(MakeRide(), std::nan(""), 0), "and the time nan");
  has(errorOf(MakeRide(), 3, 1),
    "there is a transform interpolator for dynamic connection 1, but input port 1 has 1 "
    "connections");
  auto broken = MakeRide();
  vtkNew<vtkMatrix4x4> matrix;
  matrix->SetElement(0, 3, std::nan(""));
  broken->AddTransform(4, matrix);
  has(errorOf(broken, 4, 0), "is not finite");
}

/// Where VTK evaluates splines of rotations rightly, the test of the filter's own way to see that.
TEST(TransformInterpolators, GiveNoWrongRotations)
{
  for (const auto& degrees :
    { std::vector<double>{ 0, 40, 80 }, std::vector<double>{ 30, 30, 30 } })
  {
    auto spline = WithKeys(degrees); // VTK's default
    vtkNew<vtkTransform> middle;
    spline->InterpolateTransform(1, middle);
    double rotation[4];
    middle->GetOrientationWXYZ(rotation);
    auto filter = MakeFilter(spline);
    filter->UpdateInformation();
    filter->GetOutputInformation(0)->Set(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP(), 1);
    if (std::abs(rotation[0] - degrees[1]) > 1e-6)
    {
      EXPECT_NE(OnlyErrorOf(filter).find("spline of rotations"), std::string::npos);
    }
    else
    {
      filter->Update();
      EXPECT_EQ(filter->GetOutput()->GetNumberOfBlocks(), 2u);
    }
  }
  auto straight = MakeFilter(WithKeys({ 0, 0, 0 })); // without rotation splines are right
  straight->UpdateTimeStep(1);
  EXPECT_TRUE(IsSame(OutputBits(straight), BitsAt(1.5)));
}
