// SPDX-License-Identifier: BSD-3-Clause
// Sensors and points of surfaces anywhere, and with lamps far away: in the dark but for a point
// light and a far lamp, whose light has a formula.

#include "ExtremeScenes.h"

#include "vtkIrradianceProbeFilter.h"
#include "vtkPointIrradianceFilter.h"

using namespace ExtremeScenes;

namespace
{

constexpr double Flux = 100;          ///< W of the point light
constexpr double FromFarLamp = 5;     ///< W/m2 on the floor
const Vector Light{ 1.5, 1.75, 2.5 }; ///< within the scene

struct Place
{
  Vector Position, Normal; ///< within the scene; a normal of 0: from all directions
  bool IsLit;
};

/// On the floor, below the table, on it, below its board, on the wall; at corners of the floor, in
/// the air. At the foot of the wall the wall hides a part of the far lamp.
const std::vector<Place> Places = { { { 0.5, 0.5, 0 }, { 0, 0, 1 }, true },
  { { 2, 2, 0 }, { 0, 0, 1 }, false }, { { 2, 2.25, 0.75 }, { 0, 0, 1 }, true },
  { { 2, 2, 0.75 }, { 0, 0, -1 }, false }, { { 0, 2, 1.25 }, { 1, 0, 0 }, true } };
const std::vector<Place> PlacesInTheAir = { { { 4, 0, 0 }, { 0, 0, 0 }, true },
  { { 4, 4, 0 }, { 0, 0, 0 }, true }, { { 1, 3, 1 }, { 0, 0, 0 }, true } };

Mesh Black(const Mesh& mesh, const Vector& offset)
{
  Mesh black = Placed(mesh, 1, offset);
  SetCellValues(black, "DiffuseReflectance", { 0 });
  return black;
}

/// `distance`: of a lamp above, 0: none.
Scene MakeTable(const Vector& offset, double distance)
{
  const auto moved = [&](const Vector& at) {
    return Vector{ offset[0] + at[0], offset[1] + at[1], offset[2] + at[2] };
  };
  Scene scene{ { Black(MakeRectangle({ 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 4), offset),
                 Black(MakeRectangle({ 1.25, 1.5, 0.75 }, { 1.5, 0, 0 }, { 0, 1, 0 }, 1), offset),
                 Black(MakeRectangle({ 0, 0, 0 }, { 0, 4, 0 }, { 0, 0, 3 }, 1), offset),
                 Placed(MakePointLight({ 0, 0, 0 }, { Flux }), 1, moved(Light)) },
    {} };
  if (distance > 0)
  {
    const double side = distance / 1024;
    Mesh lamp = Placed(MakeRectangle({ 0, 0, 0 }, { 0, side, 0 }, { side, 0, 0 }, 1), 1,
      moved({ 2 - side / 2, 2 - side / 2, distance }));
    SetCellValues(lamp, "DiffuseReflectance", { 0 });
    SetCellValues(lamp, "RadiantExitance", { FromFarLamp * M_PI * 1024 * 1024 });
    scene.Fixed.push_back(lamp);
  }
  return scene;
}

double TruthAt(const Place& place, bool hasFarLamp)
{
  double squared = 0, along = 0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const double away = Light[i] - place.Position[i];
    squared += away * away;
    along += away * place.Normal[i];
  }
  const bool hasNormal = place.Normal != Vector{ 0, 0, 0 };
  const double cosine = hasNormal ? along / std::sqrt(squared) : 1;
  const double fromFarLamp = hasFarLamp ? FromFarLamp * (hasNormal ? place.Normal[2] : 1) : 0;
  return place.IsLit ? Flux / (4 * M_PI * squared) * cosine + fromFarLamp : 0;
}

void ExpectTruth(vtkIrradianceFilter* filter, const std::vector<Place>& places,
  const Vector& offset, bool hasFarLamp)
{
  std::vector<Vector> positions, normals;
  for (const Place& place : places)
  {
    const Vector& at = place.Position;
    positions.push_back({ offset[0] + at[0], offset[1] + at[1], offset[2] + at[2] });
    normals.push_back(place.Normal);
  }
  const bool haveNormals = normals[0] != Vector{ 0, 0, 0 };
  const Mesh sensors = MakeSensors(positions, normals);
  if (!haveNormals)
  {
    sensors->GetPointData()->Initialize();
  }
  vtkNew<vtkIrradianceProbeFilter> probe;
  probe->SetInputData(sensors);
  probe->SetSourceConnection(filter->GetOutputPort());
  probe->SetEstimateToGathered();
  probe->SetNumberOfRays(64);
  probe->Update();
  vtkDataArray* light = vtkPointSet::SafeDownCast(probe->GetOutput())
                          ->GetPointData()
                          ->GetArray(haveNormals ? "Irradiance" : "FluenceRate");
  ASSERT_NE(light, nullptr);
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    // The nearest of the far lamps is 2e-3 rad from the wall, and 1 m of its 1000 m nearer to the
    // table.
    const double truth = TruthAt(places[i], hasFarLamp);
    EXPECT_NEAR(light->GetComponent(static_cast<vtkIdType>(i), 0), truth, 0.01 * truth + 1e-9)
      << "sensor " << i;
  }
}

/// The points of the floor: 25, of which the middle one is below the table.
void ExpectTruthAtPoints(vtkIrradianceFilter* filter, bool hasFarLamp)
{
  vtkNew<vtkPointIrradianceFilter> points;
  points->SetInputConnection(filter->GetOutputPort());
  points->SetNumberOfRays(64);
  points->Update();
  vtkPolyData* floor =
    OutputOf(vtkMultiBlockDataSet::SafeDownCast(points->GetOutputDataObject(0)), 0, 0);
  vtkDataArray* light = floor->GetPointData()->GetArray("PointIrradiance");
  ASSERT_NE(light, nullptr);
  const auto expect = [&](vtkIdType point, const Place& place) {
    const double truth = TruthAt(place, hasFarLamp);
    EXPECT_NEAR(light->GetComponent(point, 0), truth, 0.01 * truth + 1e-9) << "point " << point;
  };
  expect(6, { { 1, 1, 0 }, { 0, 0, 1 }, true });
  expect(12, { { 2, 2, 0 }, { 0, 0, 1 }, false });
  expect(18, { { 3, 3, 0 }, { 0, 0, 1 }, true });
}

}

TEST(ExtremeSensors, TheSameAnywhereAndBelowFarLamps)
{
  for (const Vector& offset :
    { Vector{ 0, 0, 0 }, Vector{ 1e5, 0, 0 }, Vector{ 5e5, 5.4e6, 300 }, Vector{ 1e7, 1e7, 1e7 } })
  {
    for (const double distance : { 0.0, 1e3, 1e6, 1e9 })
    {
      SCOPED_TRACE(testing::Message()
        << "at " << offset[0] << ", " << offset[1] << ", a lamp at " << distance << " m");
      const auto filter = MakeFilter(MakeTable(offset, distance), 1000);
      filter->SeparateSidesOff();
      ASSERT_NO_FATAL_FAILURE(ExpectTruth(filter, Places, offset, distance > 0));
      ASSERT_NO_FATAL_FAILURE(ExpectTruth(filter, PlacesInTheAir, offset, distance > 0));
      ASSERT_NO_FATAL_FAILURE(ExpectTruthAtPoints(filter, distance > 0));
    }
  }
}
