// SPDX-License-Identifier: BSD-3-Clause
// Law 6: lengths times 2^k change nothing but the units.

#include "OutputBits.h"
#include "TestScenes.h"

#include <gtest/gtest.h>

using namespace TestScenes;

namespace
{

/// Scaled by 2^k, as float or double; exact in both.
Mesh Scaled(vtkPolyData* mesh, int k, int type)
{
  Mesh scaled = Copy(mesh);
  vtkNew<vtkPoints> points;
  points->SetDataType(type);
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    const double* p = mesh->GetPoint(i);
    points->InsertNextPoint(std::ldexp(p[0], k), std::ldexp(p[1], k), std::ldexp(p[2], k));
  }
  scaled->SetPoints(points);
  return scaled;
}

vtkSmartPointer<vtkTransform> Scaled(vtkTransform* pose, int k)
{
  vtkNew<vtkMatrix4x4> matrix;
  matrix->DeepCopy(pose->GetMatrix());
  for (int row = 0; row < 3; ++row)
  {
    matrix->SetElement(row, 3, std::ldexp(matrix->GetElement(row, 3), k));
  }
  auto scaled = vtkSmartPointer<vtkTransform>::New();
  scaled->SetMatrix(matrix);
  return scaled;
}

Scene Scaled(const Scene& scene, int k, int type)
{
  Scene scaled;
  for (const Mesh& mesh : scene.Fixed)
  {
    scaled.Fixed.push_back(Scaled(mesh, k, type));
  }
  for (const MovingObject& object : scene.Moving)
  {
    scaled.Moving.push_back({ Scaled(object.Model, k, type), Scaled(object.Pose, k) });
  }
  return scaled;
}

Scene MakeTurnedScene(const Mesh& light)
{
  Scene scene = MakeSmallScene();
  scene.Fixed[1] = light;
  scene.Moving[0].Pose->RotateWXYZ(33, 1, 2, 3);
  scene.Moving[1].Pose->RotateWXYZ(-57, 2, 0, 1);
  return scene;
}

/// Every irradiance of `scaled` is the one of `original` times 2^exponent.
void ExpectScaled(vtkIrradianceFilter* original, vtkIrradianceFilter* scaled, int exponent)
{
  for (unsigned int port = 0; port < 2; ++port)
  {
    for (unsigned int i = 0; i < 2; ++i)
    {
      vtkDataArray *expected = IrradianceOf(original, port, i),
                   *found = IrradianceOf(scaled, port, i);
      ASSERT_EQ(expected->GetNumberOfTuples(), found->GetNumberOfTuples());
      for (vtkIdType cell = 0; cell < expected->GetNumberOfTuples(); ++cell)
      {
        ASSERT_EQ(
          found->GetComponent(cell, 0), std::ldexp(expected->GetComponent(cell, 0), exponent))
          << "port " << port << ", connection " << i << ", cell " << cell;
      }
    }
  }
}

/// The first frame and two updates.
void CompareFrames(const Scene& scene, int k, int type, int irradianceExponent, int powerExponent,
  int directLight = vtkIrradianceFilter::Shot)
{
  const Scene original = Scaled(scene, 0, type), scaled = Scaled(scene, k, type);
  const auto one = MakeFilter(original, 3000), other = MakeFilter(scaled, 3000);
  one->SetDirectLight(directLight);
  other->SetDirectLight(directLight);
  for (int frame = 0; frame < 3; ++frame)
  {
    SCOPED_TRACE("k " + std::to_string(k) + ", frame " + std::to_string(frame));
    one->Update();
    other->Update();
    ASSERT_GT(Field(one, "EmittedPower"), 0);
    ExpectScaled(one, other, irradianceExponent);
    for (const char* name : { "EmittedPower", "AbsorbedPower", "EscapedPower" })
    {
      EXPECT_EQ(Field(other, name), std::ldexp(Field(one, name), powerExponent)) << name;
    }
    for (const char* name : { "NumberOfSegments", "NumberOfInvalidWalks" })
    {
      EXPECT_EQ(Field(other, name), Field(one, name)) << name;
    }
    original.Moving[0].Pose->Translate(0.25, 0.125, 0);
    scaled.Moving[0].Pose->Translate(std::ldexp(0.25, k), std::ldexp(0.125, k), 0);
  }
}

class Scale : public testing::TestWithParam<std::tuple<int, int>>
{
};

}

TEST_P(Scale, KeepsTheIrradianceUnderALampOfGivenExitance)
{
  const auto [k, type] = GetParam();
  CompareFrames(MakeTurnedScene(MakeLamp({ 1.5, 1.5, 2.875 }, 0.75, { 100 })), k, type, 0, 2 * k);
}

TEST_P(Scale, DividesTheIrradianceUnderALightOfGivenFluxByTheSquare)
{
  const auto [k, type] = GetParam();
  CompareFrames(MakeTurnedScene(MakePointLight({ 1.5, 1.5, 2.5 }, { 60 })), k, type, -2 * k, 0);
}

TEST_P(Scale, KeepsTheBitsOfGatheredLight)
{
  const auto [k, type] = GetParam();
  CompareFrames(MakeTurnedScene(MakeLamp({ 1.5, 1.5, 2.875 }, 0.75, { 100 })), k, type, 0, 2 * k,
    vtkIrradianceFilter::Gathered);
  CompareFrames(MakeTurnedScene(MakePointLight({ 1.5, 1.5, 2.5 }, { 60 })), k, type, -2 * k, 0,
    vtkIrradianceFilter::Gathered);
}

INSTANTIATE_TEST_SUITE_P(OfAllLengths, Scale,
  testing::Combine(testing::Values(-10, 7), testing::Values(VTK_FLOAT, VTK_DOUBLE)));
