// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/SceneTriangles.h"

#include "Meshes/SurfacePoint.h"

#include "MovingScene.h"

#include <gtest/gtest.h>

namespace irradiance
{

namespace
{

/// The order of numbers is the order of ids, as ties between hits need it; `objects[2]` is not there.
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
      const std::uint32_t cell = objects[i].material->cellOfTriangle[k];
      const SceneCell own{ i, cell };
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

}

TEST(SceneTriangles, NumbersRunThroughAllObjects)
{
  test::MovingScene scene(1, true, 3);
  SceneObjects objects = scene.objects();
  objects.dynamicObjects[1].isPresent = false;
  const SceneTriangles triangles(objects);
  expectNumbers(triangles, objects);
  expectRecords(triangles, objects);
  EXPECT_FALSE(triangles.hasGlossy());
}

TEST(SceneTriangles, MovedObjectsArePlacedAgain)
{
  test::MovingScene scene(1, true, 3);
  SceneObjects objects = scene.objects();
  SceneTriangles triangles(objects);
  objects.dynamicObjects[0].worldFromObject.translation += Vector3(0.1, 0.2, 0.3);
  triangles.place(objects[1], 1);
  expectRecords(triangles, objects);
}

TEST(SceneTriangles, GlossyCellsAreMarked)
{
  const test::MovingScene scene(1, true, 3, true);
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
  const SceneObjects objects{ test::nothing(), {} };
  const SceneTriangles triangles(objects);
  EXPECT_EQ(triangles.size(), 0u);
  EXPECT_NE(triangles.records(), nullptr);
  EXPECT_FALSE(triangles.looks()[0].survives(0));
}

}
