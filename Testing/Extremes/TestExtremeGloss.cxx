// SPDX-License-Identifier: BSD-3-Clause
// Cells that reflect specularly, from the widest lobe to mirrors, where lengths, places, shapes and
// reflectances are extreme. All of it reflects as much as a diffuse furnace, so all has 1 W/m2.

#include "ExtremeScenes.h"

#include <limits>

using namespace ExtremeScenes;

namespace
{

const std::vector<double> Exponents{ 0, 1e4, 1e30, std::numeric_limits<double>::infinity(), 7 };

/// A furnace of gloss with a glossy box and a glossy ball. Of 30 seeds the mean of the room has a
/// standard deviation of 0.003, on the box of 0.018: 5.5 of them, a false alarm in 20 million.
class ExtremeGlossyFurnace : public testing::TestWithParam<FurnacePlace>
{
};

}

TEST_P(ExtremeGlossyFurnace, Holds)
{
  const FurnacePlace& place = GetParam();
  ExpectFurnace({ Glossy(MakeFurnace(place.Size, place.Offset), 0.4, Exponents),
                  Glossy(White(MakeBox(0.3, 0.2, 0.25)), 0.7, Exponents),
                  Glossy(White(MakeBall(0.15, 24)), 1, Exponents) },
    place, 20000, 0.0165);
}

INSTANTIATE_TEST_SUITE_P(Each, ExtremeGlossyFurnace,
  PlacesOf({ 1e-28, 1e-6, 1.0, 1e12, 1e28 }, { 1e3, 1e5, 1e7 }), NumberOf);

// A room with a floor of strips, a sheet and a needle, all of gloss and aspects of 1e6.
TEST(ExtremeGloss, Slivers)
{
  ExpectFurnaceOfSlivers([](const Scene& scene) {
    for (const Mesh& mesh : scene.Fixed)
    {
      Glossy(mesh, 0.4, Exponents);
    }
    for (const MovingObject& object : scene.Moving)
    {
      Glossy(object.Model, 1, Exponents);
    }
  });
}

// Flattened, sheared and reflected gloss.
TEST(ExtremeGloss, NearSingularAndReflectingMaps)
{
  Scene scene{ { Glossy(MakeFurnace(1, { 0, 0, 0 }), 0.4, Exponents) },
    { MakeMoving(Glossy(White(MakeBox(0.3, 0.3, 0.3)), 0.7, Exponents), { 0.5, 0.5, 0.5 }) } };
  const auto filter = MakeFilter(scene, 5000);
  for (const double flat : { 1.0, -1.0, -1e-6, 1e-13 })
  {
    for (const double shear : { 0.0, 1e3 })
    {
      SCOPED_TRACE(testing::Message() << "flattened by " << flat << ", sheared by " << shear);
      SetSheared(scene.Moving[0].Pose, flat, shear);
      ASSERT_NO_FATAL_FAILURE(ExpectLaws(filter, scene));
      EXPECT_NEAR(MeanIrradiance(filter, 0, 0), 1, InThisRun(0.04));
    }
  }
}

// Half diffuse, half specular, together 0.9999: 10,000 bounces on average, none of which may leak.
// The mean of 100 walks is known to 0.1; five times that.
TEST(ExtremeGloss, Reflectance09999)
{
  Scene scene{ { Glossy(MakeFurnace(1, { 0, 0, 0 }, 0.9999), 0.5, Exponents) },
    { MakeMoving(Glossy(White(MakeBox(0.3, 0.2, 0.25)), 1, Exponents), { 0.4, 0.5, 0.6 }) } };
  const auto filter = MakeFilter(scene, IsThorough() ? 2000 : 100);
  ASSERT_NO_FATAL_FAILURE(ExpectLaws(filter, scene));
  EXPECT_NEAR(MeanIrradiance(filter, 0, 0), 1, 0.5);
}

// A light between two mirrors, each of which shows the other: the light never comes to an end but
// through the open sides. All that escapes and is absorbed is what was emitted.
TEST(ExtremeGloss, AHallOfMirrors)
{
  const auto mirror = [](double z) {
    Mesh mesh = MakeRectangle({ 0, 0, z }, { 1, 0, 0 }, { 0, 1, 0 }, 2);
    SetCellValues(mesh, "DiffuseReflectance", { 0 });
    SetCellValues(mesh, "SpecularReflectance", { 1 });
    return mesh;
  };
  Scene scene{ { mirror(0), mirror(1e-3), MakePointLight({ 0.5, 0.5, 5e-4 }, { 1 }) },
    { MakeMoving(White(MakeBall(2e-4, 8)), { 0.6, 0.5, 5e-4 }) } };
  const auto filter = MakeFilter(scene, 1000);
  for (int frame = 0; frame < 3; ++frame)
  {
    ASSERT_NO_FATAL_FAILURE(ExpectLaws(filter, scene, false));
    // Of 1 W. What is gathered is an estimate, and so is how many walks start there.
    const bool isGathered = filter->GetDirectLight() == 1;
    EXPECT_NEAR(Field(filter, "AbsorbedPower"), 0, isGathered ? 0.02 : 0);
    scene.Moving[0].Pose->Translate(-0.05, 0.01, 0);
  }
}
