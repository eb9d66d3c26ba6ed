// SPDX-License-Identifier: BSD-3-Clause
#include "Kit.h"
#include "Meshes/SurfacePoint.h"
#include "Sampling/SobolPoint.h"
#include "Surfaces/SceneTriangles.h"

namespace irradiance::test
{
namespace
{

/// The order of numbers is the order of ids, as ties between hits need it; `objects[2]` is not
/// there.
void expectNumbers(const SceneTriangles& triangles, const SceneObjects& objects)
{
  const CellNumbers cells(objects);
  std::uint32_t number = 0;
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    for (std::uint32_t k = 0; k < objects[i].body->mesh().size(); ++k, ++number)
    {
      const TriangleId id{ i, k };
      ASSERT_EQ(triangles.numberOf(id), number);
      ASSERT_EQ(triangles.idOf(number), id);
      const SceneCell own{ i, objects[i].material->cellOfTriangle[k] };
      ASSERT_EQ(triangles.looks()[number].number(), cells[own]);
    }
  }
  EXPECT_EQ(triangles.size(), number);
  EXPECT_EQ(triangles.numberOf({}), SceneTriangles::kNone);
  EXPECT_EQ(triangles.idOf(SceneTriangles::kNone), TriangleId{});
  EXPECT_FALSE(triangles.looks()[number].survives(0));
}

void expectRecords(const SceneTriangles& triangles, const SceneObjects& objects)
{
  for (std::uint32_t number = 0; number < triangles.size(); ++number)
  {
    const TriangleId id = triangles.idOf(number);
    const Triangle& own = objects[id.object].body->mesh()[id.triangle];
    const SurfacePoint point = surfacePoint(
      id.object == 0 ? own : transformed(objects[id.object].worldFromObject, own), { 1, 0, 0 });
    const SurfaceRecord& record = triangles.records()[number];
    ASSERT_EQ(Vector3(record.normal), point.normal);
    ASSERT_EQ(record.clearance, point.clearance);
  }
}

/// As made anew.
void expectAsFresh(const SceneTriangles& triangles, const SceneObjects& objects)
{
  expectNumbers(triangles, objects);
  const SceneTriangles fresh(objects);
  ASSERT_TRUE(triangles.numbers() == fresh.numbers());
  EXPECT_EQ(triangles.hasGlossy(), fresh.hasGlossy());
  for (std::uint32_t number = 0; number < fresh.size(); ++number)
  {
    ASSERT_EQ(
      std::memcmp(triangles.records() + number, fresh.records() + number, sizeof(SurfaceRecord)),
      0);
    ASSERT_EQ(triangles.looks()[number].cell, fresh.looks()[number].cell);
    ASSERT_EQ(triangles.looks()[number].threshold, fresh.looks()[number].threshold);
  }
}

/// Changes something: a pose, who is there, the points, the look, or which objects there are.
void change(SceneObjects& objects, const SceneObjects& others, RandomVectors& random)
{
  std::vector<SceneObject>& all = objects.dynamicObjects;
  const std::size_t which = random.engine() % all.size();
  switch (random.engine() % 6)
  {
    case 0:
      all[which].worldFromObject.translation += random.inCube();
      break;
    case 1:
      all[which].isPresent = !all[which].isPresent;
      break;
    case 2:
      all[which] = others.dynamicObjects[which % others.dynamicObjects.size()];
      break;
    case 3:
      std::swap(all[which], all.front());
      break;
    case 4:
      all.push_back(all[which]);
      break;
    default:
      all.size() > 1 ? all.pop_back() : all.push_back(all.front());
  }
}

TEST(SceneTriangles, NumbersRunThroughAllObjects)
{
  MovingScene scene(1, true, 3);
  SceneObjects objects = scene.objects();
  objects.dynamicObjects[1].isPresent = false;
  const SceneTriangles triangles(objects);
  expectNumbers(triangles, objects);
  expectRecords(triangles, objects);
  EXPECT_FALSE(triangles.hasGlossy());
}

TEST(SceneTriangles, FollowTheScene)
{
  MovingScene scene(1, true, 3), glossy(1, true, 4, true);
  SceneObjects objects = scene.objects();
  SceneTriangles triangles;
  RandomVectors random(5);
  for (int step = 0; step < 80; ++step)
  {
    change(objects, step % 2 == 0 ? glossy.objects() : scene.objects(), random);
    if (step % 3 == 0)
    {
      objects.staticObject =
        step % 2 == 0 ? glossy.objects().staticObject : scene.objects().staticObject;
    }
    triangles.update(objects);
    expectAsFresh(triangles, objects);
  }
}

// So many triangles that an update can be cancelled before, among and after the looks.
TEST(SceneTriangles, AreRightAfterACancelledUpdate)
{
  const SceneObject dull = ball({ 0, 0, 0 }, 1, 60, grey(0.2));
  SceneObjects objects{ dull, { ball({ 0, 0, 0 }, 1, 70, grey(0.8)), dull } };
  ASSERT_GT(objects.staticObject.body->mesh().size(), 5000u);
  SceneTriangles triangles(objects);
  bool isCancelled = true;
  for (int before = 0; isCancelled; ++before)
  {
    std::swap(objects.staticObject, objects.dynamicObjects[0]);
    objects.dynamicObjects[1].worldFromObject.translation[0] += 0.5;
    int left = before;
    isCancelled = false;
    try
    {
      triangles.update(objects, [&] {
        if (left-- == 0)
        {
          throw std::runtime_error("cancelled");
        }
      });
    }
    catch (const std::runtime_error&)
    {
      isCancelled = true;
    }
    if (before % 2 == 0) // back to what it was before, in part
    {
      objects.dynamicObjects[1].worldFromObject.translation[0] -= 0.5;
    }
    triangles.update(objects);
    expectAsFresh(triangles, objects);
    ASSERT_LT(before, 100);
  }
}

TEST(SceneTriangles, KeepTheLooksOfWhatMoves)
{
  MovingScene scene(1, true, 3);
  SceneObjects objects = scene.objects();
  SceneTriangles triangles(objects);
  for (std::uint32_t number = 0; number < triangles.size(); ++number)
  {
    const_cast<CellLook&>(triangles.looks()[number]).threshold = number; // a mark
  }
  objects.dynamicObjects[0].worldFromObject.translation += Vector3(0.1, 0.2, 0.3);
  triangles.update(objects);
  for (std::uint32_t number = 0; number < triangles.size(); ++number)
  {
    ASSERT_EQ(triangles.looks()[number].threshold, number);
  }
  expectRecords(triangles, objects);
}

TEST(SceneTriangles, GlossyCellsAreMarked)
{
  const MovingScene scene(1, true, 3, true);
  const SceneTriangles triangles(scene.objects());
  EXPECT_TRUE(triangles.hasGlossy());
  for (std::uint32_t number = 0; number < triangles.size(); ++number)
  {
    const TriangleId id = triangles.idOf(number);
    const Material& material = *scene.objects()[id.object].material;
    ASSERT_EQ(triangles.looks()[number].isGlossy(),
      material.isSpecular(material.cellOfTriangle[id.triangle]));
  }
}

// Not even a triangle: walks from a point light escape.
TEST(SceneTriangles, AnEmptySceneHasRowsForNothing)
{
  const SceneObjects objects{ nothing(), {} };
  const SceneTriangles triangles(objects);
  EXPECT_EQ(triangles.size(), 0u);
  EXPECT_NE(triangles.records(), nullptr);
  EXPECT_FALSE(triangles.looks()[0].survives(0));
  EXPECT_NE(SceneTriangles().records(), nullptr);
  EXPECT_FALSE(SceneTriangles().looks()[0].survives(0));
}

void expectSameDecisions(double reflectance, std::uint32_t sample)
{
  const CellLook look(5, reflectance, false);
  // Around the sample, and around where the decision changes.
  const auto turns = static_cast<std::uint32_t>(std::llrint(0x1p32 * reflectance));
  for (std::uint32_t offset = 0xfffffffcu; offset != 4; ++offset)
  {
    for (const std::uint32_t c : { sample + offset, turns + offset, look.threshold + offset })
    {
      ASSERT_EQ(look.survives(c), SobolPoint::toUnit(c) < reflectance)
        << std::hexfloat << reflectance << ' ' << c;
    }
  }
}

TEST(CellLook, DecidesAsDoublesDo)
{
  std::mt19937_64 random(1);
  for (int i = 0; i < 1000000; ++i)
  {
    const auto sample = static_cast<std::uint32_t>(random());
    const double uniform = std::uniform_real_distribution<double>()(random);
    expectSameDecisions(uniform, sample);
    // A multiple of 2^-33, or next to one: thresholds lie there.
    const double tie = static_cast<double>(random() >> 31) * 0x1p-33;
    expectSameDecisions(tie, sample);
    expectSameDecisions(std::nextafter(tie, 2.0), sample);
    expectSameDecisions(std::nextafter(tie, -1.0), sample);
    expectSameDecisions(std::ldexp(uniform, -static_cast<int>(random() % 80)), sample);
    expectSameDecisions(1 - std::ldexp(uniform, -static_cast<int>(random() % 54)), sample);
  }
  for (const double extreme : { 0.0, -0.0, 1.0, 0x1p-33, 0x1p-34, 0x1p-1074, 1 - 0x1p-53,
         1 - 0x1p-33, 1 - 0x1p-34, 1.0 + 0x1p-52 })
  {
    expectSameDecisions(extreme, 0);
  }
}

TEST(CellLook, KeepsNumberAndKind)
{
  const CellLook white(CellLook::kNumber, 1, true), black(7, 0, false);
  EXPECT_EQ(white.number(), CellLook::kNumber);
  EXPECT_TRUE(white.isGlossy());
  EXPECT_TRUE(white.survives(0xffffffffu));
  EXPECT_EQ(black.number(), 7u);
  EXPECT_FALSE(black.isGlossy());
  EXPECT_FALSE(black.survives(0));
}

}
}
