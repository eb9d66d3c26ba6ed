// SPDX-License-Identifier: BSD-3-Clause
#include "DirectLight/FirstHits.h"

#include "Kit.h"

// Lights that shine mostly on static cells near to them are shot where all others are gathered.

namespace irradiance::test
{
namespace
{

constexpr double kOfWalls = 0.5;

/// Walls of 4 x 4 x 3 units, in cells of .67 x .67 and .67 x .5.
ObjectBuilder walls(double unit = 1)
{
  return plainRoom({ 4 * unit, 4 * unit, 3 * unit }, 6, grey(kOfWalls));
}

/// A square that shines down; 2 triangles.
void addLamp(ObjectBuilder& room, double height, double edge, double watts, double unit = 1)
{
  addPanel(room, unit * Vector3(1.5, 1.5, height), unit * edge, unit * edge,
    watts / (unit * unit * edge * edge));
}

/// Along the wall y = 0, to which it shines.
void addStrip(ObjectBuilder& room, double watts)
{
  room.addQuad({ 0.2, 0.05, 2 }, { 3.6, 0, 0 }, { 0, 0, 0.03 }, 1, 1, grey(0, watts / 0.108));
}

/// A panel, a strip along a wall, a lamp over the floor, and a ball that may move.
SceneObjects nearAndFar()
{
  ObjectBuilder room = walls();
  addLamp(room, 2.5, 1, 8);
  addLamp(room, 0.05, 0.05, 3);
  addStrip(room, 3);
  return { room.build(), { ball({ 0.4, 1.55, 0.25 }, 0.2, 4) } };
}

EngineSettings nearLightSettings(std::uint64_t seed, std::uint32_t walks, bool isGathered = true)
{
  return Shoot(scaled(walks)).seeded(seed).errors(16).gathered(isGathered);
}

std::vector<bool> nearLightsOf(const SceneObjects& objects)
{
  return FirstHits(objects, LightTable(objects, 1000)).nearLights();
}

TEST(NearLights, AreFoundByWhatTheyShineOn)
{
  for (const double unit : { 1.0, 0x1p-20, 0x1p30 })
  {
    ObjectBuilder room = walls(unit);
    addLamp(room, 0.05, 0.05, 1, unit);
    addLamp(room, 0.4, 0.05, 1, unit); // farther than half of a cell
    addLamp(room, 2.95, 1, 1, unit);   // near to the ceiling behind it alone
    room.addPointLight(unit * Vector3(2, 2, 0.05), 1);
    EXPECT_EQ(nearLightsOf({ room.build(), {} }),
      (std::vector<bool>{ true, true, false, false, false, false, false }))
      << "unit " << unit;
  }
  const std::vector<bool> near = nearLightsOf(nearAndFar());
  EXPECT_EQ(near, (std::vector<bool>{ false, false, true, true, true, true }));
}

TEST(NearLights, NeverDependOnWhatMayMove)
{
  ObjectBuilder room = walls(), floor, lamp;
  addLamp(room, 2.5, 1, 8);
  floor.addQuad({ 0, 0, 2.45 }, { 4, 0, 0 }, { 0, 4, 0 }, 6, 6, grey(kOfWalls));
  EXPECT_EQ(nearLightsOf({ room.build(), { floor.build() } }), std::vector<bool>(2, false));
  // A lamp itself may be of a dynamic object.
  addLamp(lamp, 0.05, 0.05, 1);
  EXPECT_EQ(nearLightsOf({ room.build(), { lamp.build() } }),
    (std::vector<bool>{ false, false, true, true }));
}

/// A lamp that lies on a wall and shines into it lights just what it covers; samples know that
/// exactly.
TEST(NearLights, AreNotThoseThatTouch)
{
  for (const double height : { 0.0, 3e-10 }) // rays start beyond the wall, or just before it
  {
    ObjectBuilder room = walls();
    addLamp(room, height, 0.05, 1);
    EXPECT_EQ(nearLightsOf({ room.build(), {} }), std::vector<bool>(2, false));
  }
}

/// What arrives at static cells and leaves them.
TEST(FirstHits, KnowHowMuchReturns)
{
  const auto returnedOf = [](const SceneObjects& objects) {
    return FirstHits(objects, LightTable(objects, 1000)).returned();
  };
  for (const double unit : { 1.0, 0x1p-20, 0x1p30 })
  {
    ObjectBuilder room = walls(unit), floor, lamp, upwards;
    addLamp(room, 2.5, 1, 8, unit);
    room.addPointLight(unit * Vector3(2, 2, 1), 3);
    EXPECT_NEAR(returnedOf({ room.build(), {} }), kOfWalls, 0.05) << "unit " << unit;
    // The lamp's own back takes some.
    EXPECT_LE(returnedOf({ room.build(), {} }), kOfWalls * (1 + 1e-12)) << "unit " << unit;
    floor.addQuad({ 0, 0, 0 }, { 4 * unit, 0, 0 }, { 0, 4 * unit, 0 }, 6, 6, grey(kOfWalls));
    addLamp(lamp, 2.5, 1, 8, unit);
    EXPECT_EQ(returnedOf({ floor.build(), { lamp.build() } }), 0) << "unit " << unit;
    upwards.addQuad(unit * Vector3(1, 1, 1), { unit, 0, 0 }, { 0, unit, 0 }, 1, 1, grey(0, 1));
    EXPECT_EQ(returnedOf({ floor.build(), { upwards.build() } }), 1) << "unit " << unit;
  }
}

/// A floor alone gathers more samples than one in a room.
TEST(FirstHits, DecideHowManySamplesThereAre)
{
  ObjectBuilder room = walls(), floor, lamp;
  floor.addQuad({ 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 6, 6, grey(kOfWalls));
  addLamp(lamp, 2.5, 1, 8);
  const WalkPlan plan(10000, 10000, 16);
  const double inRoom = gatheredOf({ room.build(), { lamp.build() } }, plan)[0].walksPerSample;
  const double alone = gatheredOf({ floor.build(), { lamp.build() } }, plan)[0].walksPerSample;
  EXPECT_GT(inRoom, 8 * alone);
  EXPECT_GE(alone, 1);
}

TEST(NearLights, HaveASourceOfTheirOwn)
{
  const WalkPlan plan(10030, 7 * 10030, 16);
  const SceneObjects objects = nearAndFar();
  const std::vector<WalkSource> sources = gatheredOf(objects, plan);
  ASSERT_EQ(sources.size(), 3u);
  EXPECT_FALSE(sources[0].cells.has_value());
  EXPECT_EQ(sources[0].lights.lights().size(), 4u);
  EXPECT_NEAR(sources[0].lights.flux(), 6, 1e-9);
  EXPECT_EQ(sources[1].cells, kStaticPart);
  EXPECT_EQ(sources[2].cells, (CellPart{ 1, 2 }));
  for (const std::size_t i : { 1, 2 })
  {
    EXPECT_EQ(sources[i].lights.lights().size(), 2u);
    EXPECT_NEAR(sources[i].lights.flux(), 8, 1e-9);
    EXPECT_TRUE(sources[i].plan == sources[1].plan);
    EXPECT_NEAR(quantaPerWatt(sources[i]) / quantaPerWatt(sources[0]), 1, 1e-6);
  }
  // Numbers of walks differ, as far as that many walks can be born.
  EXPECT_LE(sources[0].plan.endWalk(), sources[1].firstWalk);
  EXPECT_GT(sources[2].firstWalk - sources[1].firstWalk, 1u << 30);
  EXPECT_GT(0xffffffffu - sources[2].firstWalk, 1u << 30);
  EXPECT_EQ(sources[0].plan.rounds().size(), sources[1].plan.rounds().size());
  // As weak as walks that start at cells.
  const double reflected = meanReflectance(objects.staticObject);
  EXPECT_NEAR(sources[0].plan.walksAfter(1), 10030.0 * 6 / 14 / reflected, 16);
  EXPECT_NEAR(sources[1].plan.walksAfter(1), 10030.0 * 8 / 14, 16);
}

TEST(NearLights, HaveTheWholeSourceOrNoneOfIt)
{
  const WalkPlan plan(10000, 10000, 16);
  ObjectBuilder near = walls(), far = walls();
  addStrip(near, 3);
  const SceneObjects allNear{ near.build(), {} };
  std::vector<WalkSource> shot = sourcesOf(allNear, plan);
  shot[0].areNear = true;
  EXPECT_TRUE(gatheredOf(allNear, plan) == shot);

  addLamp(far, 2.5, 1, 8);
  const SceneObjects allFar{ far.build(), {} };
  std::vector<WalkSource> expected = sourcesOf(allFar, plan);
  expected[0].cells = kStaticPart;
  // The mean reflectance of the walls is a part of a shot walk's power.
  expected[0].quantaPerStart = gatheredOf(allFar, plan)[0].quantaPerStart;
  expected[0].walksPerSample = gatheredOf(allFar, plan)[0].walksPerSample;
  expected[0].fewest = gatheredOf(allFar, plan)[0].fewest;
  EXPECT_NEAR(double(expected[0].quantaPerStart),
    meanReflectance(allFar.staticObject) * double(expected[0].lights.quantaPerWalk()), 1);
  EXPECT_TRUE(gatheredOf(allFar, plan) == expected);

  const WalkPlan few(1000, 1000, 16);
  addStrip(far, 0.99 * 8 * 16 / 1000); // less than a walk of each replicate
  const SceneObjects withWeak{ far.build(), {} };
  const std::vector<WalkSource> sources = gatheredOf(withWeak, few);
  ASSERT_EQ(sources.size(), 1u);
  EXPECT_EQ(sources[0].cells, kStaticPart);
  EXPECT_EQ(sources[0].lights.lights().size(), 4u);
  EXPECT_TRUE(sources[0].plan == few);
}

TEST(NearLights, BesideASkyHaveQuantaOfTheSameWorth)
{
  SceneObjects objects = nearAndFar();
  ObjectBuilder room = walls();
  addLamp(room, 2.5, 1, 8);
  addLamp(room, 0.05, 0.05, 3);
  room.addPointLight({ 3, 3, 2 }, 5);
  objects.staticObject = room.build();
  const std::vector<WalkSource> sources = gatheredOf(underSky(objects), { 10030, 10030, 16 });
  ASSERT_EQ(sources.size(), 5u);
  for (const WalkSource& source : sources)
  {
    EXPECT_NEAR(quantaPerWatt(source) / quantaPerWatt(sources[0]), 1, 1e-6);
  }
}

/// They shoot more walks than their share.
TEST(NearLights, HaveWalksOfTheirOwn)
{
  ObjectBuilder room = walls();
  addLamp(room, 2.5, 1, 3);
  addLamp(room, 0.05, 0.05, 8);
  addStrip(room, 8);
  room.addPointLight({ 3, 3, 2 }, 3);
  const std::vector<WalkSource> sources =
    gatheredOf(underSky({ room.build(), {} }), { 10030, 4 * 10030, 16 });
  ASSERT_EQ(sources.size(), 3u);
  // No two walks that may be shot have the same number.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> numbers;
  for (const WalkSource& source : sources)
  {
    numbers.emplace_back(source.cells ? source.firstWalk : source.plan.replicates().firstWalk(),
      source.cells ? source.firstWalk + 1 : source.plan.endWalk());
  }
  std::sort(numbers.begin(), numbers.end());
  for (std::size_t i = 1; i < numbers.size(); ++i)
  {
    EXPECT_LE(numbers[i - 1].second, numbers[i].first);
  }
}

/// Of some 270 cells with an error bar, one is off by more than 5.5 standard errors (Student's t of
/// 15 degrees of freedom) in one run of 60.
TEST(NearLights, BringWhatShootingBrings)
{
  const SceneObjects objects = nearAndFar();
  const UpdatedEngine shot(objects, nearLightSettings(3, 400000, false));
  const UpdatedEngine gathered(objects, nearLightSettings(4, 400000));
  ASSERT_EQ(gathered.walks().sets().size(), 3u);
  expectBalance(gathered);
  EXPECT_NEAR(gathered.watts(gathered.balance().emitted.total()), 14, 1e-5);
  EXPECT_GT(expectAgreement(shot, gathered), kIsSanitized ? 50 : 200);
}

/// The lamp itself stays; what it shines on comes near to it.
TEST(NearLights, FollowAnotherStaticObject)
{
  const auto withFloor = [](double height) {
    ObjectBuilder room = walls();
    room.addQuad({ 0, 0, height }, { 4, 0, 0 }, { 0, 4, 0 }, 6, 6, grey(kOfWalls));
    return room.build();
  };
  ObjectBuilder lamp;
  addLamp(lamp, 1.05, 0.05, 3);
  SceneObjects objects{ withFloor(0.2), { lamp.build() } };
  EngineSettings settings = nearLightSettings(6, 10000);
  UpdatedEngine engine(objects, settings);
  EXPECT_EQ(engine.walks().sets().size(), 2u);
  objects.staticObject = withFloor(1);
  engine.update(objects, settings);
  EXPECT_EQ(engine.walks().sets().size(), 1u);
  EXPECT_TRUE(isAsFresh(engine));
}

}
}
