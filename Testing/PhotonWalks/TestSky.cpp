// SPDX-License-Identifier: BSD-3-Clause
// Sky and sun against closed forms, by walks, by gathered light and by the final gather.

#include "Kit.h"
#include "LambertContour.h"
#include "Skies.h"

namespace irradiance::test
{
namespace
{

/// How light is known.
struct SkyWay
{
  const char* name;
  EngineSettings settings;
  friend std::ostream& operator<<(std::ostream& out, const SkyWay& way) { return out << way.name; }
};

/// With 16 replicates |t| > 4.1 happens by chance in .1 % of the comparisons; seeds are fixed.
constexpr std::uint32_t kSkyReplicates = 16;
constexpr double kMostT = 4.1;

/// W/m2, with its standard error.
struct Told
{
  double value, error;
};

void expectNear(const Told& told, double truth, const std::string& what)
{
  EXPECT_TRUE(std::abs(told.value - truth) <= kMostT * told.error + 5e-4 * truth ||
    (truth == 0 && told.value == 0))
    << what;
  EXPECT_NEAR(told.value, truth, (kIsSanitized ? 0.1 : 0.015) * truth) << what;
}

Told toldOf(const ReplicateMean& mean)
{
  return { mean.mean(), mean.standardError() };
}

class SkyLight : public testing::TestWithParam<SkyWay>
{
protected:
  static EngineSettings settings()
  {
    EngineSettings settings = GetParam().settings;
    settings.separateSides = true;
    settings.replicates = kSkyReplicates;
    return settings;
  }

  /// Of each side of each cell of the static object, front and back in turn.
  static std::vector<Told> sidesOf(const SceneObjects& objects)
  {
    const UpdatedEngine engine(objects, settings());
    expectBalance(engine);
    const ErrorEstimate errors = engine.errorEstimate();
    std::vector<Told> sides;
    forEachSide(objects, true, [&](const CellSide& side, int) {
      sides.push_back({ engine.irradiance(side, 0),
        engine.watts(errors.standardError(side, 0)) / engine.cells().area(side) });
    });
    return sides;
  }
};

Box around(const ObjectBuilder& builder, double margin = 0.05)
{
  Box bounds = builder.build().mesh().bounds();
  bounds.inflate(margin);
  return bounds;
}

SceneObjects under(const ObjectBuilder& builder, const RadianceOf& radiance, double ground = 0)
{
  return { builder.build(), {}, std::make_shared<Sky>(skyOf(around(builder), radiance, ground)) };
}

Vector3 tilted(double degrees)
{
  return skyDirection(degrees, 0);
}

/// 1 x 1 m, tilted to the north.
ObjectBuilder tiltedPlane(double degrees)
{
  ObjectBuilder builder;
  const Vector3 east(1, 0, 0);
  builder.addQuad({ 0, 0, 0 }, east, tilted(degrees).cross(east), 1, 1, grey(0.3));
  return builder;
}

// Between the angles of its table a light is off by up to 5e-4.
TEST_P(SkyLight, OfTiltedPlanes)
{
  const double tilts[] = { 0, 30, 45, 60, 90 };
  const double overcast[] = { 7 * M_PI / 9, 2.206937, 1.948589, 1.635719, M_PI / 6 + 4. / 9 };
  for (std::size_t i = 0; i < 5; ++i)
  {
    const ObjectBuilder plane = tiltedPlane(tilts[i]);
    const std::string what = "tilt " + std::to_string(tilts[i]);
    const double cosine = std::cos(tilts[i] * M_PI / 180);
    const auto uniform = sidesOf(under(plane, uniformSky, 0.2));
    expectNear(uniform[0], M_PI * (1 + cosine + 0.2 * (1 - cosine)) / 2, what);
    expectNear(uniform[1], M_PI * (1 - cosine + 0.2 * (1 + cosine)) / 2, "back, " + what);
    const auto dull = sidesOf(under(plane, overcastSky));
    expectNear(dull[0], overcast[i], "overcast, " + what);
    EXPECT_TRUE(tilts[i] > 0 || dull[1].value == 0);
  }
  const RadianceOf clear = cieSky(12, 40);
  expectNear(sidesOf(under(tiltedPlane(60), clear))[0], skyIrradiance(clear, tilted(60)), "clear");
}

// The sun, parallel or a disc, is on the front alone if all of it is before the plane.
TEST_P(SkyLight, OfTheSun)
{
  for (const double radius : { 0.0, 0.2666 * M_PI / 180, 5 * M_PI / 180 })
  {
    for (const double tilt : { 0.0, 45.0, 90.0 })
    {
      const ObjectBuilder plane = tiltedPlane(tilt);
      const Vector3 sun = skyDirection(50, 60);
      const auto sides = sidesOf(
        { plane.build(), {}, std::make_shared<Sky>(sunOnly(around(plane), sun, 700, radius)) });
      const double truth = 700 * sun.dot(tilted(tilt));
      expectNear(sides[0], truth, "tilt " + std::to_string(tilt));
      EXPECT_TRUE(radius > 0 || !GetParam().settings.gathersDirectLight ||
        std::abs(sides[0].value / truth - 1) < 1e-9);
      EXPECT_EQ(sides[1].value, 0);
    }
  }
}

/// The walls of a street from south to north, 1 m wide.
std::vector<std::vector<Vector3>> wallsOf(double length, double height)
{
  std::vector<std::vector<Vector3>> walls;
  for (const double x : { -0.5, 0.5 })
  {
    const Vector3 foot(x, -length / 2, 0), along(0, length, 0), up(0, 0, height);
    walls.push_back({ foot, foot + along, foot + along + up, foot + up });
  }
  return walls;
}

// In the middle of a street between black walls.
TEST_P(SkyLight, OfAStreet)
{
  constexpr double kHeight = 0.8;
  const auto exact = [](const std::vector<std::vector<Vector3>>& walls, const Vector3& place) {
    return M_PI *
      (1 - lambertIrradiance(place, { 0, 0, 1 }, walls[0]) -
        lambertIrradiance(place, { 0, 0, 1 }, walls[1]));
  };
  EXPECT_NEAR(
    exact(wallsOf(200, kHeight), { 0, 0, 0 }), M_PI * std::cos(std::atan(2 * kHeight)), 1e-4);
  ObjectBuilder street;
  const Vector3 corner(-0.3, -1, 0), u(0.6, 0, 0), v(0, 2, 0);
  street.addQuad(corner, u, v, 1, 1, grey(0));
  const auto walls = wallsOf(6, kHeight);
  for (const auto& wall : walls)
  {
    street.addQuad(wall[0], wall[1] - wall[0], wall[3] - wall[0], 1, 1, grey(0));
  }
  const auto sides = sidesOf(under(street, uniformSky));
  expectNear(sides[0],
    meanOverRectangle(corner, u, v, 32, [&](const Vector3& p) { return exact(walls, p); }),
    "floor");
  EXPECT_EQ(sides[1].value, 0) << "underneath";
}

// Outside the quadrature, inside nothing.
TEST_P(SkyLight, OfAClosedBox)
{
  ObjectBuilder thing;
  thing.addBox(box({ 0, 0, 0 }, { 2, 1, 1 }), 1, grey(0));
  const RadianceOf clear = cieSky(13, 120);
  const auto sides = sidesOf(under(thing, clear));
  const Vector3 normals[] = { { -1, 0, 0 }, { 1, 0, 0 }, { 0, -1, 0 }, { 0, 1, 0 }, { 0, 0, -1 },
    { 0, 0, 1 } };
  for (std::size_t i = 0; i < 6; ++i)
  {
    expectNear(sides[2 * i], skyIrradiance(clear, normals[i]), "side " + std::to_string(i));
    EXPECT_EQ(sides[2 * i + 1].value, 0) << "inside";
  }
}

// CIE 171, 5.4: all that comes through a hole of A m2 in the roof arrives inside, whatever the sky.
TEST_P(SkyLight, ThroughAHoleInTheRoof)
{
  ObjectBuilder room;
  const Box walls = box({ 0, 0, 0 }, { 3, 3, 2 });
  for (int side = 0; side < 5; ++side)
  {
    room.addSide(walls, side, 2, grey(0), true);
  }
  const std::size_t inner = 20; // cells whose front is inside
  for (int i = 0; i < 9; ++i)
  {
    if (i != 4)
    {
      room.addQuad({ i % 3 * 1.0, i / 3 * 1.0, 2 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1, grey(0));
    }
  }
  const RadianceOf clear = cieSky(12, 200);
  Sky sky = skyOf(around(room), clear);
  sky.towardsSun = skyDirection(30, 200);
  sky.sunIrradiance = { 5 };
  sky.sunRadius = 0.01;
  const SceneObjects objects{ room.build(), {}, std::make_shared<Sky>(sky) };
  const double truth = skyIrradiance(clear, { 0, 0, 1 }) + 5 * std::cos(M_PI / 6);
  ReplicateMean inside, roof;
  EngineSettings seeded = settings();
  seeded.numberOfWalks /= 8;
  seeded.replicates = GetParam().settings.replicates;
  overSeeds(
    objects, 16, seeded,
    [&](const IrradianceEngine& engine) {
      double watts = 0;
      for (std::size_t i = 0; i < inner + 8; ++i)
      {
        watts += engine.irradiance({ { 0, i }, 0 }, 0) * engine.cells().area({ 0, i });
      }
      inside.add(watts);
      roof.add(engine.irradiance({ { 0, inner }, 1 }, 0));
      if (!engine.settings().gathersDirectLight)
      {
        const double entered = engine.watts(engine.balance().emitted.total());
        const double expected = DistantLight(sky).extent() + 5 * DistantLight::sunOf(sky).extent();
        EXPECT_NEAR(entered, expected, 1e-9 * expected);
      }
    },
    ThreadExecution(2));
  expectNear(toldOf(inside), truth, "inside");
  expectNear(toldOf(roof), truth, "on the roof");
}

/// Floor and walls that reflect, and something that moves.
SceneObjects yardWithHouse()
{
  ObjectBuilder yard;
  yard.addQuad({ -2, -2, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 4, 4, grey(0.5));
  yard.addBox(box({ -2, -1, 0 }, { -1, 1, 1.5 }), 3, grey(0.6));
  Sky sky = skyOf(box({ -3, -3, -0.5 }, { 3, 3, 3 }), cieSky(12, 100), 0.3);
  sky.towardsSun = skyDirection(30, 100);
  sky.sunIrradiance = { 6 };
  return { yard.build(), { ball({ 0.5, 0, 0.6 }, 0.4, 4, grey(0.7)) }, std::make_shared<Sky>(sky) };
}

// All ways agree.
TEST_P(SkyLight, ReflectedBetweenHouses)
{
  const SceneObjects objects = yardWithHouse();
  EngineSettings other = GetParam().settings;
  other.seed = 7;
  other.replicates = kSkyReplicates;
  const UpdatedEngine shot(objects, Shoot(scaled(200000)).errors(kSkyReplicates)),
    engine(objects, other);
  EXPECT_GE(expectAgreement(engine, shot), kIsSanitized ? 20 : 50);
}

const SkyWay kWays[] = { { "Walks", Shoot(scaled(1 << 18)) },
  { "GatheredLight", Shoot(scaled(1 << 16)).gathered() },
  { "FinalGather", Shoot(scaled(1 << 16)).finalGather(1024).everywhere() } };

INSTANTIATE_TEST_SUITE_P(Ways, SkyLight, testing::ValuesIn(kWays),
  [](const auto& info) { return std::string(info.param.name); });

// Of few walks no sum is read, but direct light: paths go on from there, and do not count the sky
// again where they escape.
TEST(SkyByRays, GoOnWhereWalksAreFew)
{
  const SceneObjects objects = yardWithHouse();
  const auto watts = [&](const EngineSettings& settings) {
    const UpdatedEngine engine(objects, settings);
    return estimatedWattsOn(engine, 0, 0);
  };
  const double shot = watts(Shoot(1 << 20));
  EXPECT_NEAR(watts(Shoot(100).finalGather(512).everywhere()), shot, 0.01 * shot);
  EXPECT_NEAR(watts(Shoot(100).finalGather(512).everywhere().unbiased()), shot, 0.01 * shot);
}

// No ray starts below the ground, where neither the sky nor anything else is.
TEST(SkyByRays, StartWhereThereMayBeLight)
{
  const auto raysOver = [](const RadianceOf& radiance, double ground) {
    ObjectBuilder yard;
    yard.addQuad({ 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 2, 2, grey(0.5));
    const SceneObjects objects = under(yard, radiance, ground);
    return UpdatedEngine(objects, Shoot(100).finalGather(16).everywhere())
      .statistics()
      .followedPaths;
  };
  const std::int64_t above = raysOver(overcastSky, 0);
  EXPECT_GT(above, 0);
  EXPECT_EQ(raysOver(overcastSky, 0.2), 2 * above);
}

// Sensors in the air, and on the roof of a black house.
TEST(SkyAtSensors, AreClosedForms)
{
  ObjectBuilder house;
  house.addBox(box({ 0, 0, 0 }, { 1, 1, 1 }), 1, grey(0));
  const SceneObjects objects{ house.build(), {},
    std::make_shared<Sky>(skyOf(box({ -2, -2, -2 }, { 3, 3, 3 }), uniformSky)) };
  const Vector3 up(0, 0, 1), none(0, 0, 0);
  const double below = 1 -
    lambertIrradiance({ 0.5, 0.5, -1 }, up, { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } });
  const struct
  {
    Sensor sensor;
    double truth;
  } cases[] = { { { { 0.5, 0.5, 1.5 }, up }, M_PI }, { { { 0.5, 0.5, 1.5 }, none }, 2 * M_PI },
    { { { 0.5, 0.5, 1.5 }, tilted(90) }, M_PI / 2 }, { { { 0.5, 0.5, 1.5 }, -up }, 0 },
    { { { 0.5, 0.5, -1 }, up }, M_PI * below }, { { { 0.5, 0.5, 0.5 }, none }, 0 },
    { { { 0.3, 0.7, 1 }, tilted(30) }, M_PI * (1 + std::cos(M_PI / 6)) / 2 },
    { { { 9, 9, 9 }, tilted(60) }, M_PI * 0.75 } };
  constexpr std::size_t kCases = std::size(cases);
  std::vector<ReplicateMean> means(kCases);
  for (std::uint64_t seed = 1; seed <= 16; ++seed)
  {
    std::vector<Sensor> sensors;
    for (const auto& one : cases)
    {
      sensors.push_back(one.sensor);
    }
    const auto lights = gathered(objects, Shoot(100).gathered().kept().seeded(seed), sensors, 256);
    for (std::size_t i = 0; i < kCases; ++i)
    {
      means[i].add(lights[i].value[0]);
    }
  }
  for (std::size_t i = 0; i < kCases; ++i)
  {
    expectNear(toldOf(means[i]), cases[i].truth, "case " + std::to_string(i));
  }
}

}
}
