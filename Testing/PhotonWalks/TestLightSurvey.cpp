// SPDX-License-Identifier: BSD-3-Clause
// What is known of lights before a walk is shot: how each is best known, and how unevenly they
// light what rests.

#include "DirectLight/DirectPilot.h"
#include "Kit.h"
#include "Sampling/SphericalTriangle.h"
#include "Walks/LightSurvey.h"

namespace irradiance::test
{
namespace
{

/// `n`: cells along each edge of a wall.
ObjectBuilder surveyedRoom(double exitance = 0, int n = 8)
{
  return plainRoom({ 4, 4, 3 }, n, grey(0.5, exitance));
}

/// A panel of facets below the ceiling.
void addFacets(ObjectBuilder& room)
{
  room.addQuad({ 1.4, 1.7, 2.95 }, { 0, 0.3, 0 }, { 1.2, 0, 0 }, 1, 4, grey(0, 100));
}

LightSurvey surveyOf(const SceneObjects& objects)
{
  return LightSurvey(objects, sourcesOf(objects, WalkPlan(10000, 10000, 1)));
}

/// From the part of all directions in which a point sees each cell.
double unevennessFrom(const Vector3& place, const SceneObject& room)
{
  std::vector<double> part(room.material->numberOfCells);
  const std::vector<double> areas = cellAreas(room);
  for (std::size_t i = 0; i < room.material->cellOfTriangle.size(); ++i)
  {
    part[room.material->cellOfTriangle[i]] +=
      SphericalTriangle(room.mesh()[i], place).solidAngle() / (4 * M_PI);
  }
  double squares = 0, area = 0;
  for (std::size_t cell = 0; cell < part.size(); ++cell)
  {
    squares += part[cell] * part[cell] / areas[cell];
    area += areas[cell];
  }
  return squares * area;
}

// A point light in the middle, and ones nearer and nearer to the ceiling.
TEST(LightSurvey, TellsHowUnevenlyAPointLightsARoom)
{
  for (const double below : { 1.5, 0.5, 0.1 })
  {
    ObjectBuilder room = surveyedRoom();
    const Vector3 place(2.1, 1.9, 3 - below);
    room.addPointLight(place, 10);
    const SceneObjects objects{ room.build(), {} };
    const double truth = unevennessFrom(place, objects.staticObject);
    EXPECT_NEAR(surveyOf(objects).unevenness(), truth, 0.1 * truth) << below;
  }
}

// Two lights in places of their own: of what each lights the other lights little.
TEST(LightSurvey, AddsUpLights)
{
  ObjectBuilder room = surveyedRoom(), lamp;
  room.addPointLight({ 2.1, 1.9, 2.9 }, 10);
  lamp.addPointLight({ 2.1, 1.9, 0.1 }, 10);
  const SceneObjects objects{ room.build(), { lamp.build() } };
  const double one = unevennessFrom({ 2.1, 1.9, 2.9 }, objects.staticObject);
  EXPECT_NEAR(surveyOf(objects).unevenness(), one / 2, 0.15 * one);
}

// What walls emit that are dim is sent by all alike.
TEST(LightSurvey, CountsDimLightsAsTheyShine)
{
  EXPECT_NEAR(surveyOf({ surveyedRoom(1).build(), {} }).unevenness(), 1, 0.05);
  ObjectBuilder room = surveyedRoom(1);
  room.addPointLight({ 2.1, 1.9, 2.9 }, 10);
  const SceneObjects objects{ room.build(), {} };
  const LightSurvey survey = surveyOf(objects);
  ASSERT_EQ(survey.groups()[0].known.front(), Known::Dim);
  // 80 W of dim light, of which half is reflected, and 5 W of the point's.
  const double spots = unevennessFrom({ 2.1, 1.9, 2.9 }, objects.staticObject);
  const double even = 120.0 / 125, spot = 5.0 / 125;
  EXPECT_NEAR(survey.unevenness(), even * even + 2 * even * spot + spot * spot * spots, 0.05);
}

// A panel is gathered with samples of little noise; where nothing is lit nothing is uneven.
TEST(LightSurvey, OfAPanelAndOfNothing)
{
  ObjectBuilder room = surveyedRoom();
  addFacets(room);
  const LightSurvey survey = surveyOf({ room.build(), {} });
  EXPECT_FALSE(survey.groups()[0].areHardToFind);
  EXPECT_EQ(survey.hiddenVariance(), 0);
  EXPECT_GT(survey.gatheredVariance(), 0);
  EXPECT_LT(survey.gatheredVariance(), 0.01);
  const LightSurvey none = surveyOf({ surveyedRoom().build(), {} });
  EXPECT_EQ(none.unevenness(), 1);
  EXPECT_EQ(none.gatheredVariance(), 0);
}

// Where a thing moves that is no lamp nothing is looked at again.
TEST(FrameLights, StayAsLongAsLightsDo)
{
  ObjectBuilder room = surveyedRoom(), part;
  addFacets(room);
  part.addQuad({ 1, 1, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, 2, 2, grey(0.5));
  SceneObjects objects{ room.build(), { part.build() } };
  FrameLights lights;
  ObjectSides sides;
  const WalkPlan plan(10000, 10000, 1), other(20000, 20000, 1);
  const auto lampsOf = [&](const WalkPlan& some) {
    lights.update(objects, some, sides, {});
    return lights.survey().groups()[0].lamps;
  };
  const std::shared_ptr<const LampPieces> first = lampsOf(plan);
  objects.dynamicObjects[0].worldFromObject.translation[0] = 0.5;
  EXPECT_EQ(lampsOf(plan), first);
  EXPECT_NE(lampsOf(other), first);
  // A wall that moves may touch a point in the air.
  ObjectBuilder inAir = surveyedRoom();
  inAir.addPointLight({ 1, 1, 1.5 }, 10);
  objects.staticObject = inAir.build();
  const std::shared_ptr<const LampPieces> before = lampsOf(plan);
  EXPECT_EQ(lampsOf(plan), before);
  objects.dynamicObjects[0].worldFromObject.translation[0] = 0;
  EXPECT_NE(lampsOf(plan), before);
}

/// None if shooting costs less. Where half of the light returns, and so much is the power of a walk
/// that starts at a cell.
std::optional<double> walksPerSample(const ObjectBuilder& room, double returned = 0.5)
{
  const SceneObjects objects{ room.build(), {} };
  const LampPieces lamps(LightTable(objects, 1000));
  const DirectPilot pilot(objects, lamps);
  const auto [walks, cost] = pilot.best(1, returned, std::max(0.0625, returned));
  return cost < 1 ? std::optional<double>(walks) : std::nullopt;
}

ObjectBuilder withFacets()
{
  ObjectBuilder room = surveyedRoom(0, 14);
  addFacets(room);
  return room;
}

// A sample of a panel is far better than a walk.
TEST(DirectPilot, LooksForAPanel)
{
  const std::optional<double> walks = walksPerSample(withFacets());
  ASSERT_TRUE(walks.has_value());
  EXPECT_GT(*walks, 16);
  EXPECT_LE(*walks, DirectPilot::kMostWalks);
}

// The less returns the more samples: what is gathered is nearly all light.
TEST(DirectPilot, TakesMoreSamplesWhereLittleReturns)
{
  double before = DirectPilot::kMostWalks + 1;
  for (const double returned : { 0.5, 0.2, 0.05, 0.0 })
  {
    const std::optional<double> walks = walksPerSample(withFacets(), returned);
    ASSERT_TRUE(walks.has_value()) << returned;
    EXPECT_LT(*walks, before) << returned;
    before = *walks;
  }
  EXPECT_EQ(before, DirectPilot::kFewestWalks);
}

// Facets of tubes just below a ceiling are told apart badly: walks from them have less noise.
TEST(DirectPilot, ShootsFromTubesOfManyFacets)
{
  ObjectBuilder room = surveyedRoom(0, 14);
  addTubes(room);
  EXPECT_FALSE(walksPerSample(room).has_value());
  // As a bulb far from all walls they are not.
  ObjectBuilder bulb = surveyedRoom(0, 14);
  bulb.addSphere({ 2, 2, 1.5 }, 0.1, 12, grey(0.5, 1000));
  EXPECT_TRUE(walksPerSample(bulb).has_value());
}

// Of walks from a lamp far away hardly any arrives: none is shot.
TEST(DirectPilot, LooksForWhatIsFarAway)
{
  ObjectBuilder room = surveyedRoom(0, 14);
  room.addSphere({ 2, 2, 2.85 }, 0.1, 40, grey(0.5, 1000));
  const SceneObjects objects{ room.build(), {} };
  const DirectPilot pilot(objects, LampPieces(LightTable(objects, 1000)));
  double before = 0;
  for (const double arrived : { 1e-6, 1e-3, 0.5, 1.0 })
  {
    const double cost = pilot.best(arrived, 0.5, 0.5).second;
    EXPECT_GT(cost, before);
    EXPECT_LT(cost, 10 * arrived);
    before = cost;
  }
}

// A lamp in a box with a slit lights little of what samples ask for.
TEST(DirectPilot, KnowsWhatStandsBetween)
{
  ObjectBuilder open = surveyedRoom(0, 14);
  addPanel(open, { 1.9, 1.9, 2.9 }, 0.2, 0.2, 1000);
  ObjectBuilder hidden = open;
  hidden.addQuad({ 1, 1, 2.8 }, { 1.98, 0, 0 }, { 0, 2, 0 }, 1, 1, grey(0.5));
  ASSERT_TRUE(walksPerSample(open).has_value());
  const std::optional<double> walks = walksPerSample(hidden);
  EXPECT_TRUE(!walks || *walks < *walksPerSample(open));
}

// Without a static object nothing is known, and a sample counts as a walk.
TEST(DirectPilot, KnowsNothingWithoutStaticCells)
{
  ObjectBuilder lamp;
  lamp.addQuad({ 0, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1, grey(0, 100));
  const SceneObjects objects{ nothing(), { lamp.build() } };
  const LampPieces lamps(LightTable(objects, 1000));
  EXPECT_NO_THROW(DirectPilot(objects, lamps).best(1, 0.5, 0.5));
}

}
}
