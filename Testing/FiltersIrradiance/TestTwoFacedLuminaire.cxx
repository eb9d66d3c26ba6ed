// SPDX-License-Identifier: BSD-3-Clause
// A strip that shines up and down by a table, of which cells below it see one face.

#include "TestScenes.h"

#include <gtest/gtest.h>

using namespace TestScenes;

namespace
{

constexpr double Length = 1.4, Width = 0.08, Exitance = 10; // m, m, W/m2

Mesh MakeFace(double z, bool isUp)
{
  const Vector along{ Length, 0, 0 }, across{ 0, Width, 0 }, corner{ -Length / 2, -Width / 2, z };
  return MakeRectangle(corner, isUp ? along : across, isUp ? across : along, 1);
}

/// What a black floor 1 m below gets of this lamp and of others like it.
std::vector<double> FloorBelow(const Mesh& lamp)
{
  Scene scene;
  for (const double x : { 0., 6. })
  {
    for (const double y : { 0., 4. })
    {
      scene.Fixed.push_back(Placed(lamp, 1, { x, y, 0 }));
    }
  }
  scene.Fixed.push_back(MakeRectangle({ -1, -1, -1 }, { 2, 0, 0 }, { 0, 2, 0 }, 16));
  SetCellValues(scene.Fixed.back(), "DiffuseReflectance", { 0 });
  const auto filter = MakeDefaultFilter(scene, 10000);
  filter->SetMethodToGathered();
  filter->SetNumberOfRays(64);
  filter->SetDefaultDiffuseReflectance(0);
  filter->Update();
  return ValuesOf(IrradianceOf(filter, 0, 4));
}

}

TEST(TwoFacedLuminaire, IsAskedWhereItFacesTheCell)
{
  Mesh plain = MakeFace(0, false);
  SetCellValues(plain, "RadiantExitance", { Exitance });
  Mesh luminaire = Join({ MakeFace(0, false), MakeFace(0.001, true) });
  std::vector<double> angles, intensity;
  for (int degrees = 0; degrees <= 180; ++degrees)
  {
    angles.push_back(degrees);
    intensity.push_back(std::abs(std::cos(vtkMath::RadiansFromDegrees(double(degrees)))));
  }
  SetField(luminaire, "PolarAngles", angles);
  SetField(luminaire, "RadiantIntensity", intensity);
  SetField(luminaire, "AzimuthAngles", { 0 });
  SetField(luminaire, "Flux", { 2 * Length * Width * Exitance });
  const std::vector<double> expected = FloorBelow(plain), lit = FloorBelow(luminaire);
  ASSERT_EQ(lit.size(), 256u);
  double squares = 0;
  for (std::size_t i = 0; i < lit.size(); ++i)
  {
    squares += std::pow(lit[i] / expected[i] - 1, 2) / 256;
  }
  EXPECT_LT(std::sqrt(squares), 0.04); // 0.02; 0.11 if half of the samples ask the wrong face
}
