// SPDX-License-Identifier: BSD-3-Clause
// What sensors gather, on surfaces and in the air: closed forms, agreement with cells, laws, error
// bars.

#include "Kit.h"
#include "LambertContour.h"
#include "Progress/InputError.h"
#include "Views/SensorFinalGather.h"

namespace irradiance::test
{
namespace
{

const Vector3 kNone = Vector3::Zero(); ///< the normal of a sensor that receives from all directions

EngineSettings sensorSettings(std::uint32_t walks, bool gathersDirectLight, std::uint64_t seed = 1)
{
  return Shoot(walks).seeded(seed).gathered(gathersDirectLight);
}

/// Every cell emits what it does not reflect, so E = 1 everywhere, and 4 from all directions. A
/// ball and a box stand in it.
SceneObjects furnace(int bands)
{
  ObjectBuilder crate(bands);
  crate.addBox(box({ 2.5, 1, 0 }, { 3.3, 1.7, 0.7 }), 1, grey(0.2, 0.8));
  return { plainRoom({ 4, 3, 5 }, 3, grey(0.5, 0.5), bands).build(),
    { ball({ 1, 1.5, 2 }, 0.5, 4, grey(0.7, 0.3), bands), crate.build() } };
}

/// On walls, edges, and corners, which rounding in floats may have put on either side of them; in
/// the air, oblique.
std::vector<Sensor> furnaceSensors()
{
  const double third = 3 * static_cast<double>(1.0f / 3), tiny = 0x1p-24;
  const Vector3 skew = Vector3(0.3, -0.8, 0.5).normalized();
  std::vector<Sensor> sensors{ { { 1.7, 1.1, -tiny }, { 0, 0, 1 } },
    { { -2 * tiny, 0.4, 1.9 }, { 1, 0, 0 } },
    { { 4 + 4 * tiny, 3 * third, 5 + 4 * tiny }, Vector3(-1, -1, -1).normalized() },
    { { 2.9, 1.3, 0.7 - tiny }, { 0, 0, 1 } }, { { 2.5 + tiny, 1, 0.3 }, { -1, 0, 0 } },
    { { 2, 1.5, 2.5 }, skew }, { { 1.6, 1.5, 2 }, -skew }, { { 3.7, 0.1, 4.9 }, { 0, 0, -1 } } };
  for (const Vector3& place : { Vector3(0, 0, 0), Vector3(4, 1, 5 + 2 * tiny), Vector3(2, 1.5, 2.5),
         Vector3(1, 1.5, 2.6), Vector3(-tiny, 0.7, 1.3), Vector3(2.9, 1.3, 0.9) })
  {
    sensors.push_back({ place, kNone });
  }
  return sensors;
}

// Nothing has a bias here. |t| > 5.5 of 11 degrees of freedom: once in 5,000 for each of 14 sensors
// and 4 settings, so a false alarm once in 90.
TEST(SensorFinalGather, InAFurnaceAllSensorsFindOneOrFour)
{
  const std::vector<Sensor> sensors = furnaceSensors();
  for (const auto& [bands, gathers, separates] : { std::tuple(1, false, false),
         std::tuple(1, true, false), std::tuple(3, true, true), std::tuple(1, false, true) })
  {
    const SceneObjects objects = furnace(bands);
    std::vector<ReplicateMean> means(sensors.size());
    ReplicateMean all;
    for (std::uint64_t seed = 1; seed <= 12; ++seed)
    {
      EngineSettings settings = sensorSettings(4000, gathers, seed);
      settings.separateSides = separates;
      const std::vector<SensorFinalGather::Light> lights = gathered(objects, settings, sensors);
      double mean = 0;
      for (std::size_t i = 0; i < sensors.size(); ++i)
      {
        const double truth = sensors[i].normal.isZero(0) ? 4 : 1;
        means[i].add(lights[i].value[static_cast<std::size_t>(bands - 1)] / truth);
        mean += lights[i].value[0] / truth / static_cast<double>(sensors.size());
      }
      all.add(mean);
    }
    for (std::size_t i = 0; i < sensors.size(); ++i)
    {
      EXPECT_LT(std::abs(means[i].t(1)), 5.5) << "sensor " << i << ": " << means[i].mean() << ", "
                                              << bands << " bands, gathers " << gathers;
      EXPECT_LT(means[i].standardError(), 0.06)
        << "sensor " << i << " gathers " << gathers << " mean " << means[i].mean();
    }
    EXPECT_LT(std::abs(all.t(1)), 5.5);
  }
}

// There is nothing else: no noise, and nothing is moved.
TEST(SensorFinalGather, APointLightAloneIsExact)
{
  ObjectBuilder builder;
  const Vector3 lamp(0.3, -0.2, 1.1);
  builder.addPointLight(lamp, 7);
  for (const bool gathers : { false, true })
  {
    const Vector3 place(1, 2, -0.5), away = lamp - place,
                                     normal = Vector3(0.2, 0.1, 1).normalized();
    const double fluence = 7 / (4 * M_PI * away.squaredNorm());
    EngineSettings settings = sensorSettings(100, gathers);
    settings.replicates = 4;
    const auto lights = gathered({ builder.build(), {} }, settings,
      { { place, kNone }, { place, normal }, { place, -normal }, { { 1e9, 0, 0 }, kNone } });
    EXPECT_NEAR(lights[0].value[0], fluence, 1e-12 * fluence);
    EXPECT_NEAR(lights[1].value[0], fluence * normal.dot(away.normalized()), 1e-12 * fluence);
    EXPECT_EQ(lights[2].value[0], 0);
    EXPECT_NEAR(lights[3].value[0], 7 / (4e18 * M_PI), 1e-8 * 7 / (4e18 * M_PI));
    EXPECT_EQ(lights[0].standardError[0], 0) << "it is known exactly";
    EXPECT_TRUE(std::isnan(lights[2].standardError[0])) << "nothing arrived";
  }
}

// Two plates that shine at each other, or a single one: M Omega / pi from each. Nothing reflects.
// Each sample brings as much of the fluence rate, so that it has no noise; it is off by as much as
// the sensor is taken off its place.
TEST(SensorFinalGather, FluenceBetweenPlatesIsTheirSolidAngle)
{
  ObjectBuilder plates;
  plates.addQuad({ -1, -0.5, 0 }, { 2, 0, 0 }, { 0, 1, 0 }, 1, 1, grey(0, 10));
  plates.addQuad({ -1, -0.5, 1.5 }, { 0, 1, 0 }, { 2, 0, 0 }, 1, 1, grey(0, 4));
  const std::vector<Vector3> lower{ { -1, -0.5, 0 }, { 1, -0.5, 0 }, { 1, 0.5, 0 },
    { -1, 0.5, 0 } };
  const Vector3 place(0, 0, 0.5), down(0, 0, -1);
  ReplicateMean fluence, irradiance, outside;
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
  {
    const auto lights = gathered({ plates.build(), {} }, sensorSettings(1000, seed % 2 == 0, seed),
      { { place, kNone }, { place, down }, { { 0, 0, 2 }, kNone } });
    fluence.add(lights[0].value[0]);
    irradiance.add(lights[1].value[0]);
    outside.add(lights[2].value[0]);
  }
  const auto solidAngle = [](double a, double b, double height) { // of [-a, a] x [-b, b]
    return 4 * std::asin(a * b / std::sqrt((a * a + height * height) * (b * b + height * height)));
  };
  const double truth = (10 * solidAngle(1, 0.5, 0.5) + 4 * solidAngle(1, 0.5, 1)) / M_PI;
  const double below = 10 * lambertIrradiance(place, down, lower);
  EXPECT_NEAR(fluence.mean(), truth, 4e-6 * truth);
  EXPECT_LT(fluence.standardError(), 1e-9 * truth);
  EXPECT_LT(std::abs(irradiance.t(below)), 5.5);
  EXPECT_NEAR(irradiance.mean(), below, 0.005 * below);
  EXPECT_EQ(outside.mean(), 0) << "plates shine on one side";
}

/// A lit room with a table of 4 x 4 cells.
SceneObjects roomWithTable()
{
  ObjectBuilder table;
  table.addBox(box({ 0, 0, 0 }, { 1, 1, 0.7 }), 4, grey(0.5));
  return { litRoom(8).build(), { table.build(shift({ 2.4, 0.5, 0 })) } };
}

// The mean of sensors over a cell is the irradiance of the cell, which shot walks know without
// bias. Cells that rays read are .5 m wide: 1 % is allowed for that, beside 4.5 standard errors of
// both.
TEST(SensorFinalGather, AgreesWithCells)
{
  const SceneObjects objects = roomWithTable();
  struct Patch
  {
    CellSide cell;
    Vector3 corner, u, v, normal;
  };
  // On the top of the table, on its side, on the floor below the lamp; see ObjectBuilder::addSide
  // for the order.
  const Patch patches[] = { { { { 1, 80 } }, { 2.4, 0.5, 0.7 }, { 0.25, 0, 0 }, { 0, 0.25, 0 },
                              { 0, 0, 1 } },
    { { { 0, 4 * 64 + 3 * 8 + 3 } }, { 1.5, 1.5, 0 }, { 0.5, 0, 0 }, { 0, 0.5, 0 }, { 0, 0, 1 } } };
  std::vector<Sensor> sensors;
  for (const Patch& patch : patches)
  {
    for (int i = 0; i < 64; ++i)
    {
      sensors.push_back(
        { patch.corner + patch.u * ((i % 8 + 0.5) / 8) + patch.v * ((i / 8 + 0.5) / 8),
          patch.normal });
    }
  }
  ReplicateMean cells[2], points[2];
  const int seeds = 8;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed)
  {
    const UpdatedEngine shot(
      objects, Shoot(scaled(200000)).seeded(100 + seed).unverified(), ThreadExecution(2));
    const auto lights = gathered(objects, sensorSettings(20000, seed % 2 == 0, seed), sensors, 16);
    for (std::size_t k = 0; k < 2; ++k)
    {
      cells[k].add(shot.irradiance(patches[k].cell, 0));
      double mean = 0;
      for (std::size_t i = 0; i < 64; ++i)
      {
        mean += lights[64 * k + i].value[0] / 64;
      }
      points[k].add(mean);
    }
  }
  for (std::size_t k = 0; k < 2; ++k)
  {
    EXPECT_NEAR(points[k].mean(), cells[k].mean(),
      0.01 * cells[k].mean() +
        4.5 * std::hypot(points[k].standardError(), cells[k].standardError()));
  }
}

// In a furnace the truth is known. Blocks of samples scatter more than their net errs, so intervals
// may be too wide. 24 seeds of 14 sensors, of which those of a seed read the same sums, at 95 %:
// below 90 % by chance once in 10^3.
TEST(SensorFinalGather, ErrorBarsHoldTheTruth)
{
  const std::vector<Sensor> sensors = furnaceSensors();
  const SceneObjects objects = furnace(1);
  IntervalCount intervals(16);
  for (std::uint64_t seed = 1; seed <= (kIsSanitized ? 6 : 24); ++seed)
  {
    EngineSettings settings = sensorSettings(2000, seed % 2 == 0, seed);
    settings.replicates = 16;
    const auto lights = gathered(objects, settings, sensors);
    for (std::size_t i = 0; i < sensors.size(); ++i)
    {
      const double off = lights[i].value[0] - (sensors[i].normal.isZero(0) ? 4 : 1);
      intervals.add(off, lights[i].standardError[0]);
    }
  }
  EXPECT_EQ(intervals.shareKnown(), 1);
  intervals.expectHonest();
}

// Where few walks make what rays read the main noise: replicates that shared it would claim too
// little. All walls are farther than their cells are wide. Squares of Student's t of 15 degrees
// have the mean 15 / 13 and the variance 3.3: of 40 seeds off by 4 standard errors once in 10^4 or
// so.
TEST(SensorFinalGather, ErrorBarsKnowTheNoiseOfWhatIsRead)
{
  const SceneObjects objects{ plainRoom({ 8, 8, 8 }, 3, grey(0.8, 0.2)).build(), {} };
  constexpr int kSeeds = 40;
  double squares = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed)
  {
    EngineSettings settings = sensorSettings(4000, false, seed);
    settings.replicates = 16;
    const auto lights = gathered(objects, settings, { { { 4, 4, 4 }, { 0, 0, 1 } } }, 512);
    squares += std::pow((lights[0].value[0] - 1) / lights[0].standardError[0], 2) / kSeeds;
  }
  EXPECT_LT(squares, 15.0 / 13 + 4 * std::sqrt(3.3 / kSeeds));
  EXPECT_GT(squares, 0.25) << "nor much too wide";
}

TEST(SensorFinalGather, IsDarkInsideAndKnowsWhatIsTooFar)
{
  const SceneObjects objects = roomWithTable();
  const auto lights = gathered(objects, sensorSettings(5000, false),
    { { { 2.9, 1, 0.35 }, kNone }, { { 2.9, 1, 0.35 }, { 0, 0, 1 } }, { { 2, 2, 5 }, kNone },
      { { 3e6, 0, 0 }, kNone }, { { 8e6, 0, 0 }, kNone } });
  EXPECT_EQ(lights[0].value[0], 0) << "in the table";
  EXPECT_EQ(lights[1].value[0], 0);
  EXPECT_EQ(lights[2].value[0], 0) << "above the ceiling";
  EXPECT_EQ(lights[3].value[0], 0) << "outside";
  EXPECT_TRUE(std::isnan(lights[4].value[0]));
}

// From nine sizes of the scene away: of what the cells of a plate received, as the same engine
// says, the part that their view factors give. The point light is exact.
TEST(SensorFinalGather, SeesFromAfarWhatCellsReflect)
{
  ObjectBuilder builder;
  const Vector3 lamp(0.5, 0.5, 0.4), place(0.4, 0.7, 9), down(0, 0, -1);
  builder.addQuad({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 2, 2, grey(0.8));
  builder.addPointLight(lamp, 100);
  const SceneObjects objects{ builder.build(), {} };
  const double height = place[2] - lamp[2];
  const double direct = 100 / (4 * M_PI) * height / std::pow((place - lamp).norm(), 3);
  ReplicateMean ratio;
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
  {
    UpdatedEngine engine(objects, sensorSettings(10000, false, seed));
    double expected = 0;
    for (std::size_t cell = 0; cell < 4; ++cell)
    {
      const Vector3 corner(0.5 * double(cell % 2), 0.5 * double(cell / 2), 0);
      const Vector3 u(0.5, 0, 0), v(0, 0.5, 0);
      expected += 0.8 * engine.irradiance({ { 0, cell } }, 0) *
        lambertIrradiance(place, down, { corner, corner + u, corner + u + v, corner + v });
    }
    const auto found = gathered(engine, { { place, down } }, 16384);
    ratio.add((found[0].value[0] - direct) / expected);
  }
  EXPECT_LT(std::abs(ratio.t(1)), 5.5);
  EXPECT_LT(ratio.standardError(), 0.05);
}

TEST(SensorFinalGather, WithoutLightOrSurfaceThereIsNothing)
{
  ObjectBuilder dark = plainRoom({ 1, 1, 1 }, 2, grey(0.5)), lamp;
  lamp.addPointLight({ 1, 2, 3 }, 5);
  const std::vector<Sensor> sensors{ { { 0.3, 0.2, 0.5 }, kNone }, { { 1, 2, 3 }, kNone } };
  for (const SceneObject& object : { dark.build(), lamp.build(), nothing() })
  {
    const auto lights = gathered({ object, {} }, sensorSettings(1000, false), sensors);
    EXPECT_EQ(lights[0].value[0] > 0, object.emission != nullptr);
    EXPECT_EQ(lights[1].value[0], 0) << "at the very place of the light, too";
  }
}

TEST(SensorFinalGather, RefusesPointLightsBesideSpecularCells)
{
  const MovingScene glossy(1, true, 5, true);
  EXPECT_THROW(gathered(glossy.objects(), sensorSettings(1000, true), {}), InputError);
}

}
}
