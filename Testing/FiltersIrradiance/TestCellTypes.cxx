// SPDX-License-Identifier: BSD-3-Clause
// Every kind of cell of a vtkPolyData, in its order.

#include "ErrorObserver.h"
#include "TestScenes.h"

#include "vtkMath.h"

#include <gtest/gtest.h>

using namespace TestScenes;

namespace
{

vtkSmartPointer<vtkCellArray> MakeCells(const std::vector<std::vector<vtkIdType>>& cells)
{
  auto array = vtkSmartPointer<vtkCellArray>::New();
  for (const auto& cell : cells)
  {
    array->InsertNextCell(static_cast<vtkIdType>(cell.size()), cell.data());
  }
  return array;
}

/// A light high above gives every cell of the plane z = 0 the same irradiance, if each has its own
/// area and receives its own light. At height h, flux F: F / (4 pi h^2) to within (2 / h)^2.
void ExpectUniform(const Mesh& mesh, vtkIdType firstSurface)
{
  const double height = 20, flux = 4 * vtkMath::Pi() * height * height * 10;
  const Scene scene{ { mesh, MakePointLight({ 0.5, 0.5, height }, { flux }) }, {} };
  const auto filter = MakeFilter(scene, 4000000);
  filter->SetDefaultDiffuseReflectance(0);
  filter->Update();
  vtkDataArray* irradiance = IrradianceOf(filter, 0, 0);
  ASSERT_EQ(irradiance->GetNumberOfTuples(), mesh->GetNumberOfCells());
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    const double expected = i < firstSurface ? 0 : 10;
    EXPECT_NEAR(irradiance->GetComponent(i, 0), expected, 0.1 * expected) << "cell " << i;
  }
}

}

TEST(CellTypes, VerticesLinesPolygonsAndStripsInOneMesh)
{
  // 3 x 2 squares of 2 m around the origin
  std::vector<Vector> corners;
  for (int i = 0; i < 12; ++i)
  {
    corners.push_back({ 2.0 * (i % 4) - 3, 2.0 * (i / 4) - 2, 0 });
  }
  Mesh mesh = MakePoints(corners);
  mesh->SetVerts(MakeCells({ { 0 }, { 1, 2, 3 } }));
  mesh->SetLines(MakeCells({ { 0, 1 }, { 4, 5, 6 } }));
  mesh->SetPolys(MakeCells({ { 0, 1, 5 }, { 0, 5, 4 }, { 1, 2, 6, 5 } }));
  mesh->SetStrips(MakeCells({ { 4, 5, 8, 9, 10 }, { 2, 3, 6, 7 } }));
  ExpectUniform(mesh, 4);
}

TEST(CellTypes, ConcavePolygons)
{
  // An arrowhead, whose notch is filled by another one, and a staircase.
  Mesh mesh = MakePoints(
    { { 0, 0, 0 }, { 2, 2, 0 }, { 0, 1, 0 }, { -2, 2, 0 }, { 0, 3, 0 }, { -2, 0, 0 }, { -2, -3, 0 },
      { 2, -3, 0 }, { 2, -2, 0 }, { 0, -2, 0 }, { 0, -1, 0 }, { -1, -1, 0 }, { -1, 0, 0 } });
  mesh->SetPolys(MakeCells({ { 0, 1, 2, 3 }, { 2, 1, 4, 3 }, { 5, 6, 7, 8, 9, 10, 11, 12 } }));
  ExpectUniform(mesh, 0);
}

// A plate of 4 m with a hole of 2 m, cut open along one edge, 1 m above a floor, 2 m below a light.
TEST(CellTypes, PolygonWithAHole)
{
  Mesh plate = MakePoints({ { 0, 0, 1 }, { 4, 0, 1 }, { 4, 4, 1 }, { 0, 4, 1 }, { 1, 1, 1 },
    { 1, 3, 1 }, { 3, 3, 1 }, { 3, 1, 1 } });
  plate->SetPolys(MakeCells({ { 0, 1, 2, 3, 0, 4, 5, 6, 7, 4 } }));
  SetCellValues(plate, "RadiantExitance", { 5 });
  const auto shining = MakeFilter({ { plate }, {} }, 10000);
  EXPECT_TRUE(Update(shining).Warnings.empty());
  EXPECT_NEAR(Field(shining, "EmittedPower"), 5 * (16 - 4), 1e-6);

  SetCellValues(plate, "RadiantExitance", { 0 });
  const Mesh below = MakeRectangle({ 1.5, 1.5, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1);
  const Mesh shaded = MakeRectangle({ 4, 1.5, 0 }, { 0.5, 0, 0 }, { 0, 1, 0 }, 1);
  const double height = 3, flux = 4 * vtkMath::Pi() * height * height * 10;
  const Mesh light = MakePointLight({ 2, 2, height }, { flux });
  const auto filter = MakeFilter({ { plate, Join({ below, shaded }), light }, {} }, 400000);
  filter->SetDefaultDiffuseReflectance(0);
  filter->Update();
  // F / (4 pi h^2) to within (0.5 / h)^2
  EXPECT_NEAR(IrradianceOf(filter, 0, 1)->GetComponent(0, 0), 10, 0.4);
  EXPECT_EQ(IrradianceOf(filter, 0, 1)->GetComponent(1, 0), 0);
}

TEST(CellTypes, PolygonsThatCrossThemselvesAreReported)
{
  Mesh mesh =
    MakePoints({ { 0, 0, 0 }, { 1, 1, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 2, 0, 0 }, { 2, 2, 0 } });
  mesh->SetPolys(MakeCells({ { 0, 4, 5 }, { 0, 1, 2, 3 }, { 0, 1, 5, 4, 2, 3 } }));
  SetCellValues(mesh, "RadiantExitance", { 8 });
  const auto filter = MakeFilter({ {}, { MakeMoving(mesh, { 0, 0, 0 }) } }, 10000);
  ExpectOnlyWarning(
    filter, { "input port 1, connection 0", "cross themselves", "2 cells", "cell 1;" });
  // Both lobes of each: two of 1/4 m2; 1/4 m2 and half a square of 2 m less its tip of 1/4 m2.
  EXPECT_NEAR(Field(filter, "EmittedPower"), 8 * (2 + 0.5 + 0.25 + 1.75), 1e-6);
}

// Every triangle of a strip has its front on the side of the first one's.
TEST(CellTypes, FrontOfAStrip)
{
  Mesh mesh = MakePoints({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 }, { 0, 2, 0 } });
  mesh->SetStrips(MakeCells({ { 0, 1, 2, 3, 4 } }));
  const Scene scene{ { mesh, MakePointLight({ 0.5, 0.5, 1 }, { 60 }) }, {} };
  const auto filter = MakeFilter(scene, 10000);
  filter->SeparateSidesOn();
  filter->Update();
  vtkCellData* cells = OutputOf(filter->GetOutput(), 0, 0)->GetCellData();
  EXPECT_GT(cells->GetArray("IrradianceFront")->GetComponent(0, 0), 1);
  EXPECT_EQ(cells->GetArray("IrradianceBack")->GetComponent(0, 0), 0);
}

// The points of a poly-vertex share its flux.
TEST(CellTypes, PolyVertexIsSeveralLights)
{
  Mesh lights = MakePoints({ { 1, 1, 1 }, { 9, 9, 1 } });
  lights->SetVerts(MakeCells({ { 0, 1 } }));
  SetCellValues(lights, "RadiantFlux", { 60 });
  const Mesh near = MakeRectangle({ 0, 0, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 1);
  const Mesh far = MakeRectangle({ 8, 8, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 1);
  const auto filter = MakeFilter({ { Join({ near, far }), lights }, {} }, 60000);
  filter->SetDefaultDiffuseReflectance(0);
  filter->Update();
  // Each cell is a face of a cube of 2 m around a light and receives a sixth of half the flux. The
  // other light, 11.3 m away, adds less than 1 m / (4 pi (11.3 m)^3) of its flux per m2.
  for (vtkIdType cell = 0; cell < 2; ++cell)
  {
    EXPECT_NEAR(IrradianceOf(filter, 0, 0)->GetComponent(cell, 0), 30.0 / 6 / 4, 0.03);
  }
  EXPECT_EQ(Field(filter, "EmittedPower"), 60);
}
