// SPDX-License-Identifier: BSD-3-Clause
// What is known of lights before a walk is shot: how each is best known, and how unevenly they
// light what rests.

#include "Walks/LightSurvey.h"

#include "Sampling/SphericalTriangle.h"
#include "TestScenes.h"

#include <gtest/gtest.h>

namespace irradiance
{

namespace
{

using test::grey;
using test::ObjectBuilder;

constexpr int kCells = 8; ///< along each edge of a wall

ObjectBuilder walls(double exitance = 0)
{
  ObjectBuilder room;
  room.addBox(test::box({ 0, 0, 0 }, { 4, 4, 3 }), kCells, grey(0.5, exitance), true);
  return room;
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

}

// A point light in the middle, and ones nearer and nearer to the ceiling.
TEST(LightSurvey, TellsHowUnevenlyAPointLightsARoom)
{
  for (const double below : { 1.5, 0.5, 0.1 })
  {
    ObjectBuilder room = walls();
    const Vector3 place(2.1, 1.9, 3 - below);
    room.addPointLight(place, 10);
    const SceneObjects objects{ room.build(), {} };
    const double truth = unevennessFrom(place, objects.staticObject);
    EXPECT_NEAR(surveyOf(objects).unevenness(), truth, 0.1 * truth) << below;
  }
}

// Two lights in places of their own are as uneven as both together, whether they are one group or
// two.
TEST(LightSurvey, AddsUpGroups)
{
  for (const bool areTwo : { false, true })
  {
    ObjectBuilder room = walls(), lamp;
    room.addPointLight({ 2.1, 1.9, 2.9 }, 10);
    lamp.addPointLight({ 2.1, 1.9, 0.1 }, 10);
    SceneObjects objects{ room.build(), { lamp.build() } };
    if (areTwo)
    {
      auto emission = std::make_shared<Emission>(*objects.dynamicObjects[0].emission);
      emission->groups = { 1 };
      objects.dynamicObjects[0].emission = emission;
    }
    const double one = unevennessFrom({ 2.1, 1.9, 2.9 }, objects.staticObject);
    // Of what each lights the other lights little.
    EXPECT_NEAR(surveyOf(objects).unevenness(), one / 2, 0.15 * one) << areTwo;
  }
}

// What walls emit that are dim is sent by all alike.
TEST(LightSurvey, CountsDimLightsAsTheyShine)
{
  EXPECT_NEAR(surveyOf({ walls(1).build(), {} }).unevenness(), 1, 0.05);
  ObjectBuilder room = walls(1);
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
  ObjectBuilder room = walls();
  room.addQuad({ 1.4, 1.7, 2.95 }, { 0, 0.3, 0 }, { 1.2, 0, 0 }, 1, 4, grey(0, 100));
  const LightSurvey survey = surveyOf({ room.build(), {} });
  EXPECT_FALSE(survey.groups()[0].areHardToFind);
  EXPECT_EQ(survey.hiddenVariance(), 0);
  EXPECT_GT(survey.gatheredVariance(), 0);
  EXPECT_LT(survey.gatheredVariance(), 0.01);
  const LightSurvey none = surveyOf({ walls().build(), {} });
  EXPECT_EQ(none.unevenness(), 1);
  EXPECT_EQ(none.gatheredVariance(), 0);
}

// Where a thing moves that is no lamp nothing is looked at again.
TEST(FrameLights, StayAsLongAsLightsDo)
{
  ObjectBuilder room = walls(), part;
  room.addQuad({ 1.4, 1.7, 2.95 }, { 0, 0.3, 0 }, { 1.2, 0, 0 }, 1, 4, grey(0, 100));
  part.addQuad({ 1, 1, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, 2, 2, grey(0.5));
  SceneObjects objects{ room.build(), { part.build() } };
  FrameLights lights;
  ObjectSides sides;
  const WalkPlan plan(10000, 10000, 1), other(20000, 20000, 1);
  const LightSurvey* const first = &lights.survey(objects, plan, sides, {});
  const LampPieces* const lamps = first->groups()[0].lamps.get();
  objects.dynamicObjects[0].worldFromObject.translation[0] = 0.5;
  EXPECT_EQ(lights.survey(objects, plan, sides, {}).groups()[0].lamps.get(), lamps);
  const std::shared_ptr<const LampPieces> kept = first->groups()[0].lamps;
  EXPECT_NE(lights.survey(objects, other, sides, {}).groups()[0].lamps, kept);
  // A wall that moves may touch a point in the air.
  ObjectBuilder inAir = walls();
  inAir.addPointLight({ 1, 1, 1.5 }, 10);
  objects.staticObject = inAir.build();
  const std::shared_ptr<const LampPieces> before =
    lights.survey(objects, plan, sides, {}).groups()[0].lamps;
  EXPECT_EQ(lights.survey(objects, plan, sides, {}).groups()[0].lamps, before);
  objects.dynamicObjects[0].worldFromObject.translation[0] = 0;
  EXPECT_NE(lights.survey(objects, plan, sides, {}).groups()[0].lamps, before);
}

}
