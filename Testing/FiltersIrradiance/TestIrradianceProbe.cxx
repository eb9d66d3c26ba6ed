// SPDX-License-Identifier: BSD-3-Clause
// Irradiance at sensor points from the nearest photons.

#include "ErrorObserver.h"
#include "TestScenes.h"

#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIrradianceProbeFilter.h"
#include "vtkKeyFramedPose.h"
#include "vtkMath.h"

#include <gtest/gtest.h>

#include <limits>

using namespace TestScenes;

namespace
{

vtkSmartPointer<vtkPolyData> MakeSensors(
  const std::vector<Vector>& positions, const std::vector<Vector>& normals)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> array;
  array->SetNumberOfComponents(3);
  array->SetName("Normals");
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    points->InsertNextPoint(positions[i].data());
    array->InsertNextTuple(normals[i].data());
  }
  auto sensors = vtkSmartPointer<vtkPolyData>::New();
  sensors->SetPoints(points);
  sensors->GetPointData()->SetNormals(array);
  return sensors;
}

struct Pipeline
{
  vtkSmartPointer<vtkIrradianceFilter> Irradiance;
  vtkNew<vtkIrradianceProbeFilter> Probe;
  vtkSmartPointer<ErrorObserver> Errors = ErrorObserver::Watch(Probe);

  Pipeline(const Scene& scene, vtkIdType walks, vtkPolyData* sensors)
    : Irradiance(MakeFilter(scene, walks))
  {
    this->Probe->SetInputData(sensors);
    this->Probe->SetSourceConnection(this->Irradiance->GetOutputPort());
    this->Probe->SetEstimateToNearest();
  }
  double Value(const char* name, vtkIdType point)
  {
    return this->Probe->GetOutput()->GetPointData()->GetArray(name)->GetComponent(point, 0);
  }
  std::vector<double> Update()
  {
    this->Probe->Update();
    std::vector<double> values;
    for (const char* name : { "Irradiance", "NumberOfPhotons", "SearchRadius" })
    {
      vtkDataArray* array = this->Probe->GetOutput()->GetPointData()->GetArray(name);
      for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
      {
        values.push_back(array->GetComponent(i, 0));
      }
    }
    return values;
  }
  void ExpectError(const std::string& words)
  {
    this->Errors->Clear();
    this->Probe->Update();
    ASSERT_EQ(this->Errors->Errors.size(), 1u);
    EXPECT_NE(this->Errors->Errors[0].find(words), std::string::npos) << this->Errors->Errors[0];
    EXPECT_EQ(this->Probe->GetOutput()->GetNumberOfPoints(), 0);
  }
};

/// View factor from a small area at the origin, facing up, to the rectangle [0, a] x [0, b] at
/// height c (Howell's B-4).
double CornerFactor(double a, double b, double c)
{
  const double x = a / c, y = b / c;
  const double p = std::sqrt(1 + x * x), q = std::sqrt(1 + y * y);
  return (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / (2 * vtkMath::Pi());
}

/// Signed, for corners on both sides.
double SignedFactor(double a, double b, double c)
{
  const double sign = (a < 0) != (b < 0) ? -1 : 1;
  return sign * CornerFactor(std::abs(a), std::abs(b), c);
}

/// Irradiance on a floor point below a lamp [0, 1]^2 at height 1 of exitance 10.
double BelowLamp(double x, double y)
{
  const double c = 1;
  return 10 *
    (SignedFactor(1 - x, 1 - y, c) - SignedFactor(-x, 1 - y, c) - SignedFactor(1 - x, -y, c) +
      SignedFactor(-x, -y, c));
}

/// The mean of that over the part of the plate within a distance of a point.
double MeanBelowLamp(double x, double y, double radius)
{
  constexpr int steps = 200;
  double sum = 0;
  int count = 0;
  for (int i = 0; i < steps * steps; ++i)
  {
    const double px = x + radius * (2 * (i % steps + 0.5) / steps - 1);
    const double py = y + radius * (2 * (i / steps + 0.5) / steps - 1);
    if (std::hypot(px - x, py - y) <= radius && std::min(px, py) >= 0 && std::max(px, py) <= 1)
    {
      sum += BelowLamp(px, py);
      ++count;
    }
  }
  return sum / count;
}

/// A black plate below a lamp of its own size.
Scene MakePlateAndLamp()
{
  Scene scene;
  scene.Fixed = { MakeRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1),
    MakeLamp({ 0.5, 0.5, 1 }, 1, { 10 }) };
  SetCellValues(scene.Fixed[0], "DiffuseReflectance", { 0 });
  SetCellValues(scene.Fixed[1], "DiffuseReflectance", { 0 });
  return scene;
}

}

// A million walks, of which some 200,000 reach the plate. What is estimated is the mean over the
// part of the plate within the SearchRadius: nothing is lost beyond an edge. 2,000 photons: 2.2 %
// standard error; 8 % is over 3.5 of them, a false alarm in 0.4 % of all choices of 9 sensors; 2.5
// % of the mean in 0.1 %.
TEST(IrradianceProbe, AgreesWithTheClosedFormAtEdgesAndCornersToo)
{
  std::vector<Vector> positions;
  for (const double x : { 0.0, 0.5, 1.0 })
  {
    for (const double y : { 0.0, 0.4, 1.0 })
    {
      positions.push_back({ x, y, 0 });
    }
  }
  const auto sensors = MakeSensors(positions, std::vector<Vector>(positions.size(), { 0, 0, 3 }));
  Pipeline pipeline(MakePlateAndLamp(), 1000000, sensors);
  pipeline.Probe->SetNumberOfPhotons(2000);
  pipeline.Update();
  ASSERT_TRUE(pipeline.Errors->Errors.empty());
  double mean = 0;
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    const double truth = MeanBelowLamp(
      positions[i][0], positions[i][1], pipeline.Value("SearchRadius", static_cast<vtkIdType>(i)));
    const double relative = pipeline.Value("Irradiance", static_cast<vtkIdType>(i)) / truth - 1;
    std::printf("(%.1f, %.1f): %.3f W/m2, off by %+.2f %%, radius %.3f m\n", positions[i][0],
      positions[i][1], truth, 100 * relative,
      pipeline.Value("SearchRadius", static_cast<vtkIdType>(i)));
    EXPECT_NEAR(relative, 0, 0.08);
    EXPECT_EQ(pipeline.Value("NumberOfPhotons", static_cast<vtkIdType>(i)), 2000);
    mean += relative / static_cast<double>(positions.size());
  }
  EXPECT_NEAR(mean, 0, 0.025);
}

// Gathered at the very point: no mean over a radius, not even in the corners. 64 samples by solid
// angle are off by .7 % at most here.
TEST(IrradianceProbe, GatheredLightIsThatOfThePoint)
{
  std::vector<Vector> positions;
  for (int i = 0; i < 121; ++i)
  {
    positions.push_back({ i % 11 / 10.0, i / 11 / 10.0, 0.001 }); // a little above the plate
  }
  const auto sensors = MakeSensors(positions, std::vector<Vector>(positions.size(), { 0, 0, 3 }));
  Pipeline pipeline(MakePlateAndLamp(), 1000, sensors);
  pipeline.Irradiance->SetDirectLightToGathered();
  pipeline.Update();
  ASSERT_TRUE(pipeline.Errors->Errors.empty());
  double mean = 0, worst = 0;
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    const double truth = BelowLamp(positions[i][0], positions[i][1]);
    const double relative = pipeline.Value("Irradiance", static_cast<vtkIdType>(i)) / truth - 1;
    worst = std::max(worst, std::abs(relative));
    mean += relative / static_cast<double>(positions.size());
    EXPECT_EQ(pipeline.Value("NumberOfPhotons", static_cast<vtkIdType>(i)), 0) << "all is black";
  }
  std::printf("off by %.4f %% at most, %+.5f %% on the average\n", 100 * worst, 100 * mean);
  EXPECT_LT(worst, 0.01);
  EXPECT_NEAR(mean, 0, 5e-4);
}

TEST(IrradianceProbe, TheOtherSideOfAThinWallDoesNotCount)
{
  const auto sensors = MakeSensors({ { 0.5, 0.5, 0 }, { 0.5, 0.5, 0 }, { 0.5, 0.5, 5 } },
    { { 0, 0, 1 }, { 0, 0, -1 }, { 1, 0, 0 } });
  Pipeline pipeline(MakePlateAndLamp(), 10000, sensors);
  pipeline.Update();
  EXPECT_GT(pipeline.Value("Irradiance", 0), 1);
  EXPECT_EQ(pipeline.Value("Irradiance", 1), 0) << "there is surface, but no light";
  EXPECT_EQ(pipeline.Value("NumberOfPhotons", 1), 0);
  EXPECT_TRUE(std::isnan(pipeline.Value("Irradiance", 2))) << "no surface faces that way";
}

TEST(IrradianceProbe, FewerPhotonsThanAskedForAreAllThatThereAre)
{
  const auto sensors = MakeSensors({ { 0.5, 0.5, 0 } }, { { 0, 0, 1 } });
  Pipeline pipeline(MakePlateAndLamp(), 1000, sensors);
  pipeline.Probe->SetNumberOfPhotons(100000);
  pipeline.Probe->SetMaximumRadius(0.9); // the lamp is farther away
  pipeline.Update();
  const double received =
    IrradianceOf(pipeline.Irradiance, 0, 0)->GetComponent(0, 0); // of the whole plate, 1 m2
  EXPECT_NEAR(pipeline.Value("Irradiance", 0), received, 1e-9 * received);
  EXPECT_LT(pipeline.Value("NumberOfPhotons", 0), 1000);
  pipeline.Probe->SetMaximumRadius(0.05);
  pipeline.Update();
  EXPECT_EQ(pipeline.Value("SearchRadius", 0), 0.05);
}

// Law 1, and law 2 in the order of the sensors.
TEST(IrradianceProbe, AfterUpdatesItEqualsANewFilter)
{
  Scene scene = MakeSmallScene();
  std::vector<Vector> positions, normals;
  RandomNumbers random(7);
  for (int i = 0; i < 300; ++i)
  {
    positions.push_back({ random.Between(0, 3), random.Between(0, 3), 0 });
    normals.push_back({ 0, 0, 1 });
  }
  const auto sensors = MakeSensors(positions, normals);
  Pipeline pipeline(scene, 5000, sensors);
  for (int frame = 0; frame < 20; ++frame)
  {
    scene.Moving[frame % 2].Pose->Translate(0.03, -0.01, 0);
    scene.Moving[frame % 2].Pose->RotateZ(5);
    const std::vector<double> updated = pipeline.Update();
    Pipeline fresh(scene, 5000, sensors);
    ASSERT_EQ(updated, fresh.Update()) << "frame " << frame;
  }
  EXPECT_GT(Field(pipeline.Irradiance, "NumberOfInvalidWalks"), 0);
}

// A deforming input has a new tree.
TEST(IrradianceProbe, FollowsDeformingInputs)
{
  Scene scene = MakeSmallScene();
  const auto sensors = MakeSensors(
    { { 1, 1, 1.4 }, { 1, 1, 0.6 }, { 1.4, 1, 1 } }, { { 0, 0, 1 }, { 0, 0, -1 }, { 1, 0, 0 } });
  const double anyDistance = std::numeric_limits<double>::infinity();
  Pipeline pipeline(scene, 5000, sensors);
  pipeline.Probe->SetMaximumDistance(anyDistance);
  pipeline.Update();
  for (int frame = 1; frame < 5; ++frame)
  {
    vtkPoints* points = scene.Moving[0].Model->GetPoints();
    for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
    {
      double p[3];
      points->GetPoint(i, p);
      points->SetPoint(i, 1.02 * p[0], 0.99 * p[1], p[2]);
    }
    points->Modified();
    scene.Moving[0].Model->Modified();
    const std::vector<double> updated = pipeline.Update();
    Pipeline fresh(scene, 5000, sensors);
    fresh.Probe->SetMaximumDistance(anyDistance);
    ASSERT_EQ(updated, fresh.Update()) << "frame " << frame;
  }
}

// A working plane, and what is outside of everything. A sensor near a surface has the photons of
// the closest point of it. Sizes of any unit.
TEST(IrradianceProbe, SensorsInTheAirAreUnknownAndSaidToBe)
{
  for (const double unit : { 1.0, 0x1p-40, 0x1p40 })
  {
    Scene scene;
    scene.Fixed = { MakeRectangle(
                      { -2 * unit, -2 * unit, 0 }, { 4 * unit, 0, 0 }, { 0, 4 * unit, 0 }, 4),
      MakeLamp({ 0, 0, 2 * unit }, unit, { 10 }) };
    const auto sensors = MakeSensors({ { 0, 0, 0 }, { 0, 0, 0.85 * unit }, { 0, 0, 0.03 * unit },
                                       { 9 * unit, 0, 0 }, { 0, 0, -0.03 * unit } },
      std::vector<Vector>(5, { 0, 0, 1 }));
    Pipeline pipeline(scene, 20000, sensors);
    pipeline.Update();
    EXPECT_TRUE(pipeline.Errors->Errors.empty());
    ASSERT_EQ(pipeline.Errors->Warnings.size(), 1u);
    const std::string& warning = pipeline.Errors->Warnings[0];
    EXPECT_NE(warning.find("2 of 5 sensors lie farther than"), std::string::npos) << warning;
    EXPECT_NE(warning.find("the first is point 1 at (0, 0, "), std::string::npos) << warning;
    for (const vtkIdType lost : { 1, 3 })
    {
      EXPECT_TRUE(std::isnan(pipeline.Value("Irradiance", lost)));
      EXPECT_TRUE(std::isnan(pipeline.Value("SearchRadius", lost)));
      EXPECT_EQ(pipeline.Value("NumberOfPhotons", lost), 0);
    }
    EXPECT_GT(pipeline.Value("NumberOfPhotons", 0), 40);
    for (const vtkIdType near : { 2, 4 })
    {
      EXPECT_EQ(pipeline.Value("Irradiance", near), pipeline.Value("Irradiance", 0));
    }
    pipeline.Errors->Clear();
    pipeline.Probe->SetMaximumDistance(std::numeric_limits<double>::infinity());
    pipeline.Update();
    EXPECT_TRUE(pipeline.Errors->Warnings.empty());
    EXPECT_EQ(pipeline.Value("Irradiance", 1), pipeline.Value("Irradiance", 0));
  }
}

TEST(IrradianceProbe, BadInputIsNamed)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto good = MakeSensors({ { 0.5, 0.5, 0 } }, { { 0, 0, 1 } });
  Pipeline pipeline(MakePlateAndLamp(), 1000, good);
  vtkNew<vtkPolyData> without;
  without->SetPoints(good->GetPoints());
  pipeline.Probe->SetInputData(without);
  pipeline.ExpectError("no point normals");
  pipeline.Probe->SetInputData(
    MakeSensors({ { 0, 0, 0 }, { 1, 1, 0 } }, { { 0, 0, 1 }, { 0, 0, 0 } }));
  pipeline.ExpectError("point 1: the normal (0, 0, 0) is of length 0");
  pipeline.Probe->SetInputData(MakeSensors({ { 0, 0, 0 } }, { { 0, nan, 0 } }));
  pipeline.ExpectError("point 0: the normal (0, nan, 0) is not finite");
  pipeline.Probe->SetInputData(MakeSensors({ { nan, 0, 0 } }, { { 0, 0, 1 } }));
  pipeline.ExpectError("point 0: the position (nan, 0, 0) is not finite");
  pipeline.Probe->SetInputData(good);
  pipeline.Probe->SetMaximumRadius(-1);
  pipeline.ExpectError("MaximumRadius is -1");
  pipeline.Probe->SetMaximumRadius(1);
  pipeline.Probe->SetMaximumDistance(nan);
  pipeline.ExpectError("MaximumDistance is nan");
  pipeline.Probe->SetMaximumDistance(0);
  vtkNew<vtkMultiBlockDataSet> foreign;
  pipeline.Probe->SetSourceData(foreign);
  pipeline.ExpectError("the source is no output of vtkIrradianceFilter");
  pipeline.Probe->SetSourceConnection(pipeline.Irradiance->GetOutputPort());
  pipeline.Errors->Clear();
  pipeline.Update();
  EXPECT_TRUE(pipeline.Errors->Errors.empty());
  EXPECT_GT(pipeline.Value("Irradiance", 0), 0);
}

// It has been said once, upstream. VTK executes what is behind a filter that failed when that is
// updated again.
TEST(IrradianceProbe, IsSilentAboutWhatUpstreamCouldNotCompute)
{
  const auto sensors = MakeSensors({ { 0.5, 0.5, 0 } }, { { 0, 0, 1 } });
  vtkNew<vtkKeyFramedPose> pose;
  pose->SetInputData(MakeBox(0.1, 0.1, 0.1));
  pose->AddPose(0, 0.5, 0.5, 0.5, 0, 0, 0);
  Pipeline pipeline(MakePlateAndLamp(), 1000, sensors);
  pipeline.Irradiance->AddInputConnection(1, pose->GetOutputPort());
  const auto poseErrors = ErrorObserver::Watch(pose),
             irradianceErrors = ErrorObserver::Watch(pipeline.Irradiance);
  pose->Update();
  pipeline.Irradiance->Update();
  pipeline.Update();
  EXPECT_FALSE(poseErrors->Errors.empty()) << "it has one key alone";
  EXPECT_TRUE(irradianceErrors->Errors.empty());
  EXPECT_EQ(irradianceErrors->Failures, 0);
  EXPECT_EQ(pipeline.Irradiance->GetOutput()->GetNumberOfBlocks(), 0u)
    << "not the light without it";
  EXPECT_TRUE(pipeline.Errors->Errors.empty());
  EXPECT_EQ(pipeline.Probe->GetOutput()->GetNumberOfPoints(), 0);
  pose->AddPose(1, 0.5, 0.5, 0.75, 0, 0, 0);
  pipeline.Update();
  EXPECT_GT(pipeline.Value("Irradiance", 0), 0);
}
