// SPDX-License-Identifier: BSD-3-Clause
// Direct light, shot and gathered, agrees in scenes that differ in what they ask for.
// TestDirectLight.cxx has four more.

#include "Agreement.h"

using namespace TestScenes;

namespace
{

/// Each cell at random, in each band.
void SetRandomValues(
  vtkPolyData* mesh, const char* name, int bands, double low, double high, RandomNumbers& random)
{
  SetCellValues(mesh, name, std::vector<double>(static_cast<std::size_t>(bands)));
  vtkDataArray* values = mesh->GetCellData()->GetArray(name);
  for (vtkIdType cell = 0; cell < values->GetNumberOfTuples(); ++cell)
  {
    for (int band = 0; band < bands; ++band)
    {
      values->SetComponent(cell, band, random.Between(low, high));
    }
  }
}

}

// As many lights as a table has, of fluxes from 1 to 100; some hang so near the ceiling that they
// light little else.
TEST(DirectLightAgreement, AHundredLights)
{
  RandomNumbers random(5);
  Scene scene{ { MakeRoom(4, 4) }, { MakeMoving(MakeBall(0.5, 8), { 2, 2, 1 }) } };
  for (int i = 0; i < 100; ++i)
  {
    const double x = random.Between(0.2, 3.8), y = random.Between(0.2, 3.8),
                 z = random.Between(2, 3.9), flux = std::pow(10, random.Between(0, 2));
    scene.Fixed.push_back(i % 2 == 0 ? MakePointLight({ x, y, z }, { flux })
                                     : MakeLamp({ x, y, z }, 0.1, { 100 * flux }));
  }
  ExpectAgreement(scene, false);
}

// A strip of 5.6 m under a shelf; both sides of the shelf.
TEST(DirectLightAgreement, ALongStrip)
{
  const Mesh strip = MakeRectangle({ 0.2, 0.6, 2 }, { 0, 0.05, 0 }, { 5.6, 0, 0 }, 1);
  SetCellValues(strip, "RadiantExitance", { 200 });
  const Mesh shelf = MakeRectangle({ 0, 0, 2.1 }, { 6, 0, 0 }, { 0, 1.2, 0 }, 4);
  ExpectAgreement(
    { { MakeRoom(6, 4), strip, shelf }, { MakeMoving(MakeBox(1, 1, 1), { 3, 1, 1 }) } }, true);
}

// Balls and boxes in each other, in walls, and one of them around a light.
TEST(DirectLightAgreement, ThingsInsideEachOther)
{
  ExpectAgreement({ { MakeRoom(3, 3), MakeLamp({ 1.5, 1.5, 2.9 }, 0.6, { 100 }),
                      MakePointLight({ 2.2, 2.2, 1 }, { 30 }) },
                    { MakeMoving(MakeBall(0.5, 8), { 1, 1, 1 }),
                      MakeMoving(MakeBox(0.8, 0.5, 0.6), { 1.3, 1.1, 1.1 }),
                      MakeMoving(MakeBall(0.6, 8), { 0, 2, 0.4 }),
                      MakeMoving(MakeBox(0.5, 0.5, 0.5), { 2.2, 2.2, 1 }) } },
    true);
}

// A texture: in three bands each cell reflects otherwise, some specularly, and so do the things.
TEST(DirectLightAgreement, ATextureOfReflectances)
{
  RandomNumbers random(6);
  Mesh room = MakeRoom(3, 5), ball = MakeBall(0.5, 10);
  for (const Mesh& mesh : { room, ball })
  {
    SetRandomValues(mesh, "DiffuseReflectance", 3, 0, 0.6, random);
    SetRandomValues(mesh, "SpecularReflectance", 3, 0, 0.4, random);
    SetRandomValues(mesh, "PhongExponent", 1, 0, 50, random);
  }
  ExpectAgreement({ { room, MakeLamp({ 1, 1, 2.5 }, 0.7, { 30, 100, 10 }),
                      MakeLamp({ 2, 2.5, 2.7 }, 0.3, { 200, 0, 50 }) },
                    { MakeMoving(ball, { 1.6, 1.2, 1 }) } },
    false);
}

// Point lights in a corner, in a wall, on the edge of a table, and near a ball.
TEST(DirectLightAgreement, PointLightsWhereTheyTouch)
{
  const Mesh table = MakeRectangle({ 1, 1, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, 3);
  ExpectAgreement(
    { { MakeRoom(3, 3), table, MakePointLight({ 0, 0, 3 }, { 10 }),
        MakePointLight({ 1.2, 0, 1.5 }, { 20 }), MakePointLight({ 2, 1.5, 1.5 }, { 20 }) },
      { MakeMoving(MakeBall(0.3, 8), { 2.3, 1.5, 1.5 }) } },
    true);
}

// A floor and a lamp as long as a hall of 100 m, of few cells, and things in it that are small
// beside them.
TEST(DirectLightAgreement, SmallThingsInALongHall)
{
  const auto floorOf = [](double z, double width, double direction) {
    return MakeRectangle(
      { 0, -0.5 * width * direction, z }, { 100, 0, 0 }, { 0, width * direction, 0 }, 4);
  };
  const Mesh lamp = floorOf(4, 0.2, -1);
  SetCellValues(lamp, "RadiantExitance", { 50 });
  ExpectAgreement(
    { { floorOf(0, 6, 1), floorOf(4.2, 6, -1), lamp },
      { MakeMoving(MakeBox(8, 1, 1), { 50, 0, 0.5 }), MakeMoving(MakeBox(6, 2, 0.02), { 30, 0, 1 }),
        MakeMoving(MakeBox(2, 5, 1), { 70, 0, 1 }) } },
    true);
}
