// SPDX-License-Identifier: BSD-3-Clause
// The Guide's way to values at the corners of cells: the surfaces themselves are the sensors of vtkIrradianceProbeFilter.

#include "ErrorObserver.h"
#include "TestScenes.h"

#include "vtkCompositeDataGeometryFilter.h"
#include "vtkIrradianceProbeFilter.h"
#include "vtkPolyDataNormals.h"
#include "vtkShrinkFilter.h"
#include "vtkTriangleFilter.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

using namespace TestScenes;

namespace
{

/// All surfaces of a scene, each triangle with corners of its own.
struct Corners
{
  vtkSmartPointer<vtkIrradianceFilter> Irradiance;
  vtkNew<vtkCompositeDataGeometryFilter> Surfaces;
  vtkNew<vtkTriangleFilter> Triangles;
  vtkNew<vtkPolyDataNormals> Normals;
  vtkNew<vtkShrinkFilter> Inwards;
  vtkNew<vtkIrradianceProbeFilter> Probe;
  vtkSmartPointer<ErrorObserver> Errors = ErrorObserver::Watch(Probe);

  Corners(const Scene& scene, vtkIdType walks)
    : Irradiance(MakeFilter(scene, walks))
  {
    this->Surfaces->SetInputConnection(this->Irradiance->GetOutputPort());
    this->Triangles->SetInputConnection(this->Surfaces->GetOutputPort());
    this->Triangles->PassVertsOff();
    this->Triangles->PassLinesOff();
    this->Normals->SetInputConnection(this->Triangles->GetOutputPort());
    this->Normals->ConsistencyOff();
    this->Inwards->SetInputConnection(this->Normals->GetOutputPort());
    this->Inwards->SetShrinkFactor(0.9999);
    this->Probe->SetInputConnection(this->Inwards->GetOutputPort());
    this->Probe->SetSourceConnection(this->Irradiance->GetOutputPort());
  }
  std::vector<double> Update()
  {
    this->Probe->Update();
    EXPECT_TRUE(this->Errors->Errors.empty()) << testing::PrintToString(this->Errors->Errors);
    EXPECT_TRUE(this->Errors->Warnings.empty());
    std::vector<double> values;
    vtkDataArray* array = this->Probe->GetOutput()->GetPointData()->GetArray("Irradiance");
    for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
    {
      values.push_back(array->GetComponent(i, 0));
    }
    return values;
  }
};

}

// A point light over a black floor: at each corner what the formula says. Corners lie within 1e-4 of a cell of where they
// belong.
TEST(PointIrradiance, UnderAPointLightIsThatOfTheFormula)
{
  Scene scene;
  scene.Fixed = { MakeRectangle({ -2, -2, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 5),
    MakePointLight({ 0.3, 0.1, 1.5 }, { 100 }) };
  SetCellValues(scene.Fixed[0], "DiffuseReflectance", { 0 });
  Corners corners(scene, 100);
  const std::vector<double> values = corners.Update();
  ASSERT_EQ(values.size(), 6u * 25);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    double place[3];
    corners.Probe->GetOutput()->GetPoint(static_cast<vtkIdType>(i), place);
    const double x = place[0] - 0.3, y = place[1] - 0.1, z = place[2] - 1.5;
    const double truth = 100 / (4 * M_PI) * 1.5 / std::pow(x * x + y * y + z * z, 1.5);
    EXPECT_NEAR(values[i], truth, 1e-5 * truth);
  }
}

// A light in the middle of a black ball of which all corners are 1 m away: the same everywhere, as far as mean normals of facets are
// those of the ball.
TEST(PointIrradiance, OfALightInABallIsEven)
{
  Scene scene;
  Mesh ball = MakeBall(1, 24);
  ball->GetPointData()->Initialize();
  SetCellValues(ball, "DiffuseReflectance", { 0 });
  scene.Fixed = { ball, MakePointLight({ 0, 0, 0 }, { 4 * M_PI }) };
  Corners corners(scene, 100);
  corners.Normals->FlipNormalsOn(); // light comes from within
  corners.Normals->SplittingOff();
  const std::vector<double> values = corners.Update();
  ASSERT_GT(values.size(), 1000u);
  for (const double value : values)
  {
    EXPECT_NEAR(value, 1, 0.01);
  }
}

// Corners of walls see all that their own wall sees, those where walls meet as well: E = 1 in a furnace. Each is off by some 5 %.
TEST(PointIrradiance, InAFurnaceAllCornersFindOne)
{
  Scene scene;
  scene.Fixed = { MakeRoom(3, 4) };
  SetCellValues(scene.Fixed[0], "DiffuseReflectance", { 0.6 });
  SetCellValues(scene.Fixed[0], "RadiantExitance", { 0.4 });
  Corners corners(scene, 20000);
  corners.Probe->SetNumberOfRays(16);
  const std::vector<double> values = corners.Update();
  ASSERT_EQ(values.size(), 6u * 6 * 16);
  double mean = 0;
  for (const double value : values)
  {
    EXPECT_NEAR(value, 1, 0.5);
    mean += value / static_cast<double>(values.size());
  }
  EXPECT_NEAR(mean, 1, 0.03);
}

// Law 1: the corners move with the surfaces.
TEST(PointIrradiance, AfterUpdatesItIsThatOfANewFilter)
{
  Scene scene = MakeSmallScene();
  Corners corners(scene, 2000);
  corners.Probe->SetNumberOfRays(8);
  std::vector<double> before;
  for (int frame = 0; frame < 3; ++frame)
  {
    scene.Moving[frame % 2].Pose->Translate(0.03, -0.01, 0);
    Corners fresh(scene, 2000);
    fresh.Probe->SetNumberOfRays(8);
    const std::vector<double> updated = corners.Update(), expected = fresh.Update();
    ASSERT_EQ(updated.size(), expected.size());
    EXPECT_EQ(std::memcmp(updated.data(), expected.data(), updated.size() * sizeof(double)), 0);
    EXPECT_NE(updated, before);
    before = updated;
  }
}
