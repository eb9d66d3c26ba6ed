// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../FiltersIrradiance/ErrorObserver.h"
#include "../FiltersIrradiance/OutputBits.h"
#include "../FiltersIrradiance/OutputChecks.h"
#include "../FiltersIrradiance/TestScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

/// Scenes at the limits, and what must hold in all of them.
namespace ExtremeScenes
{

using namespace TestScenes;
using OutputChecks::AreaOf;

/// True for the full numbers, which take minutes: VTKIRRADIANCE_TEST_EFFORT above 1.
inline bool IsThorough()
{
  const char* effort = std::getenv("VTKIRRADIANCE_TEST_EFFORT");
  return effort && std::atoi(effort) > 1;
}

/// How filters know direct light in this run of all tests: VTKIRRADIANCE_TEST_DIRECT_LIGHT 1 for
/// gathered.
inline int DirectLightOfThisRun()
{
  const char* gathered = std::getenv("VTKIRRADIANCE_TEST_DIRECT_LIGHT");
  return gathered && std::atoi(gathered) == 1 ? 1 : 0;
}

/// How far a mean of a furnace may be off. Where all cells shine, and walks are few, gathered light
/// has up to twelve times the noise of shot light: each cell is near to lamps, and asks four times
/// which.
inline double InThisRun(double allowed)
{
  return DirectLightOfThisRun() == 1 ? 12 * allowed : allowed;
}

/// A cube of side `size` at `offset`. Every cell reflects `reflectance` and emits so much that the
/// irradiance is `level` everywhere, also on objects inside it that reflect all light.
inline Mesh MakeFurnace(
  double size, const Vector& offset, double reflectance = 0.5, double level = 1, int resolution = 3)
{
  Mesh room = Placed(MakeRoom(1, resolution), size, offset);
  SetCellValues(room, "DiffuseReflectance", { reflectance });
  SetCellValues(room, "RadiantExitance", { level * (1 - reflectance) });
  return room;
}

inline Mesh White(const Mesh& mesh)
{
  SetCellValues(mesh, "DiffuseReflectance", { 1 });
  return mesh;
}

/// The walls of a furnace of 1 m, and its floor of strips, every other one of which is 1e-6 wide.
inline std::vector<Mesh> MakeFurnaceOfStrips()
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> strips;
  constexpr int kStrips = 20;
  for (int i = 0; i <= kStrips; ++i)
  {
    const double x = (i / 2) / (0.5 * kStrips) + (i % 2 != 0 ? 1e-6 : 0);
    points->InsertNextPoint(x, 0, 0);
    points->InsertNextPoint(x, 1, 0);
  }
  for (vtkIdType i = 0; i < kStrips; ++i)
  {
    const vtkIdType ids[4] = { 2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1 };
    strips->InsertNextCell(4, ids);
  }
  auto floor = Mesh::New();
  floor->SetPoints(points);
  floor->SetPolys(strips);
  Mesh room = Placed(MakeRoom(1, 2), 1, { 0, 0, 0 });
  vtkNew<vtkCellArray> walls; // all but the floor, which comes first
  for (vtkIdType cell = 4; cell < room->GetNumberOfCells(); ++cell)
  {
    vtkNew<vtkIdList> ids;
    room->GetCellPoints(cell, ids);
    walls->InsertNextCell(ids);
  }
  room->SetPolys(walls);
  for (const Mesh& mesh : { room, floor })
  {
    SetCellValues(mesh, "DiffuseReflectance", { 0.5 });
    SetCellValues(mesh, "RadiantExitance", { 0.5 });
  }
  return { room, floor };
}

/// In the middle of a unit room: flattened along an axis, which may reflect, and sheared.
inline void SetSheared(vtkTransform* pose, double flat, double shear)
{
  const double small = shear > 0 ? 1 / shear : 1;
  const double matrix[16] = { 0.8 * small, shear * small * flat, 0.1, 0, 0.2, flat, -0.1, 0, -0.1,
    0.3 * flat, 1, 0, 0, 0, 0, 1 };
  pose->Identity();
  pose->Translate(0.5, 0.5, 0.5);
  pose->Concatenate(matrix);
}

/// Cell by cell in turn: Phong exponents, infinite for mirrors.
inline void SetExponents(vtkPolyData* mesh, const std::vector<double>& exponents)
{
  SetCellValues(mesh, "PhongExponent", { 0 });
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    mesh->GetCellData()
      ->GetArray("PhongExponent")
      ->SetComponent(cell, 0, exponents[static_cast<std::size_t>(cell) % exponents.size()]);
  }
}

/// Lets a mesh of a furnace reflect `part` of what it reflects specularly.
inline Mesh Glossy(const Mesh& mesh, double part, const std::vector<double>& exponents)
{
  const double all = mesh->GetCellData()->GetArray("DiffuseReflectance")->GetComponent(0, 0);
  SetCellValues(mesh, "DiffuseReflectance", { (1 - part) * all });
  SetCellValues(mesh, "SpecularReflectance", { part * all });
  SetExponents(mesh, exponents);
  return mesh;
}

/// A dynamic object at `position` of a furnace; model and position are in units of its size.
inline MovingObject MakeMovingIn(
  const Mesh& unitModel, double size, const Vector& offset, const Vector& position)
{
  return MakeMoving(Placed(unitModel, size, { 0, 0, 0 }),
    { offset[0] + size * position[0], offset[1] + size * position[1],
      offset[2] + size * position[2] });
}

/// W on cells [first, last) of an output block; last < 0: all.
inline double Received(vtkIrradianceFilter* filter, unsigned int port, unsigned int i,
  vtkIdType first = 0, vtkIdType last = -1)
{
  vtkPolyData* mesh = OutputOf(filter->GetOutput(), port, i);
  vtkDataArray* irradiance = IrradianceOf(filter, port, i);
  double watts = 0;
  for (vtkIdType cell = first; cell < (last < 0 ? mesh->GetNumberOfCells() : last); ++cell)
  {
    watts += irradiance->GetComponent(cell, 0) * AreaOf(mesh, cell);
  }
  return watts;
}

/// Area mean, W/m2.
inline double MeanIrradiance(vtkIrradianceFilter* filter, unsigned int port, unsigned int i)
{
  vtkPolyData* mesh = OutputOf(filter->GetOutput(), port, i);
  double area = 0;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    area += AreaOf(mesh, cell);
  }
  return Received(filter, port, i) / area;
}

/// Updates, and checks what holds in every scene: no error, power in = power out to the last bit,
/// finite numbers, and the bits of a new filter. `isClosed`: nothing escapes. Where direct light is
/// gathered, what escapes is an estimate, of which the sum of two doubles loses a bit.
inline void ExpectLaws(vtkIrradianceFilter* filter, const Scene& scene, bool isClosed = true)
{
  const bool isGathered = DirectLightOfThisRun() == 1;
  filter->SetDirectLight(DirectLightOfThisRun());
  const auto observer = ErrorObserver::Watch(filter);
  filter->Update();
  ASSERT_TRUE(observer->Errors.empty()) << observer->Errors[0];
  const double emitted = Field(filter, "EmittedPower");
  const double escaped = Field(filter, "EscapedPower");
  EXPECT_GT(emitted, 0);
  EXPECT_NEAR(emitted, Field(filter, "AbsorbedPower") + escaped,
    isGathered ? 1e-14 * std::max(emitted, std::abs(escaped)) : 0);
  if (isClosed && !isGathered)
  {
    EXPECT_EQ(escaped, 0);
  }
  for (unsigned int port = 0; port < 2; ++port)
  {
    const std::size_t blocks = port == 0 ? scene.Fixed.size() : scene.Moving.size();
    for (unsigned int i = 0; i < blocks; ++i)
    {
      vtkDataArray* irradiance = IrradianceOf(filter, port, i);
      for (vtkIdType cell = 0; cell < irradiance->GetNumberOfTuples(); ++cell)
      {
        const double value = irradiance->GetComponent(cell, 0);
        ASSERT_TRUE(std::isfinite(value) && value >= 0) << value << " on cell " << cell;
      }
    }
  }
  if (!scene.Moving.empty())
  {
    const auto fresh = MakeFilter(scene, filter->GetNumberOfWalks());
    fresh->SetDirectLight(filter->GetDirectLight());
    fresh->SetCellEstimate(filter->GetCellEstimate());
    fresh->SetNumberOfSpreadPhotons(filter->GetNumberOfSpreadPhotons());
    fresh->SetSeparateSides(filter->GetSeparateSides());
    fresh->Update();
    EXPECT_TRUE(IsSame(OutputBits(filter), OutputBits(fresh)));
  }
}

/// Where a furnace is.
struct FurnacePlace
{
  double Size;
  Vector Offset = { 0, 0, 0 };
  friend std::ostream& operator<<(std::ostream& os, const FurnacePlace& place)
  {
    return os << "size " << place.Size << ", offset " << place.Offset[0];
  }
};

/// Of some sizes, m, at the origin; and of 1 cm, so that size and offset both matter, as many sizes
/// away.
inline auto PlacesOf(const std::vector<double>& sizes, const std::vector<double>& distances)
{
  std::vector<FurnacePlace> places;
  for (const double size : sizes)
  {
    places.push_back({ size });
  }
  for (const double distance : distances)
  {
    const double far = distance * 0.01;
    places.push_back({ 0.01, { far, -0.7 * far, 0.4 * far } });
  }
  return testing::ValuesIn(places);
}

constexpr auto NumberOf = [](const auto& info) { return "Number" + std::to_string(info.index); };

/// A furnace at a place. `meshes`: its room, and a box and a ball that move in it.
/// The mean irradiance of the room is 1 within `allowed`, of the box within 0.1, in repaired frames
/// too.
inline void ExpectFurnace(
  const std::vector<Mesh>& meshes, const FurnacePlace& place, vtkIdType walks, double allowed)
{
  const auto& [size, offset] = place;
  Scene scene{ { meshes[0] },
    { MakeMovingIn(meshes[1], size, offset, { 0.4, 0.5, 0.6 }),
      MakeMovingIn(meshes[2], size, offset, { 0.7, 0.7, 0.4 }) } };
  const auto filter = MakeFilter(scene, walks);
  for (int frame = 0; frame < 3; ++frame)
  {
    SCOPED_TRACE("frame " + std::to_string(frame));
    ASSERT_NO_FATAL_FAILURE(ExpectLaws(filter, scene));
    EXPECT_NEAR(MeanIrradiance(filter, 0, 0), 1, InThisRun(allowed));
    EXPECT_NEAR(MeanIrradiance(filter, 1, 0), 1, 0.1);
    EXPECT_EQ(Field(filter, "ShootSeconds") > 0, frame == 0);
    scene.Moving[0].Pose->RotateWXYZ(25, 1, 2, 3);
    scene.Moving[0].Pose->Translate(0.05 * size, 0.1 * size, -0.1 * size);
    scene.Moving[1].Pose->Translate(-0.01 * size, 0.02 * size, 0.05 * size);
  }
}

/// A furnace with a floor of strips, a white sheet 1e-6 thick and a needle 7e-7 wide. `look`
/// changes how they reflect.
template <class Look>
void ExpectFurnaceOfSlivers(const Look& look)
{
  Scene scene{ MakeFurnaceOfStrips(),
    { MakeMoving(White(Placed(MakeBox(0.5, 0.5, 1e-6), 1, { 0, 0, 0 })), { 0.4, 0.5, 0.6 }),
      MakeMoving(White(Placed(MakeBox(0.7, 7e-7, 7e-7), 1, { 0, 0, 0 })), { 0.5, 0.4, 0.3 }) } };
  look(scene);
  const auto filter = MakeFilter(scene, 20000);
  for (int frame = 0; frame < 4; ++frame)
  {
    ASSERT_NO_FATAL_FAILURE(ExpectLaws(filter, scene));
    EXPECT_NEAR(MeanIrradiance(filter, 0, 0), 1, 0.02);
    EXPECT_NEAR(MeanIrradiance(filter, 0, 1), 1, 0.06);
    EXPECT_NEAR(MeanIrradiance(filter, 1, 0), 1, 0.1);
    scene.Moving[0].Pose->RotateWXYZ(40, 1, 0.3, 0.2);
    scene.Moving[1].Pose->RotateWXYZ(33, 0.1, 0.3, 1);
  }
}

/// The only error of the update of a scene; the output must be empty.
inline std::string ErrorOf(const Scene& scene, vtkIdType walks = 100)
{
  const auto filter = MakeFilter(scene, walks);
  filter->SetDirectLight(DirectLightOfThisRun());
  return OnlyErrorOf(filter);
}

}
