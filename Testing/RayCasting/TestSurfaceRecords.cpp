// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/SurfaceRecords.h"

#include "TestRays.h"
#include "TestScenes.h"

#include <gtest/gtest.h>

#include <cstring>
#include <stdexcept>

namespace irradiance
{
namespace
{

using test::exactly;
using test::NamedScene;

/// A surface point as a loop over records computes it.
SurfacePoint pointOf(const SurfaceRecord& record, const Vector3& weights)
{
  Vector3 kept;
  for (int corner = 0; corner < 3; ++corner)
  {
    kept[corner] = weights[corner] > record.inset[corner] ? weights[corner] : record.inset[corner];
  }
  const double scale = 1 / (kept[0] + kept[1] + kept[2]);
  SurfacePoint point{ {}, {}, record.clearance, true };
  for (int axis = 0; axis < 3; ++axis)
  {
    point.position[axis] =
      (kept[0] * record.a[axis] + kept[1] * record.b[axis] + kept[2] * record.c[axis]) * scale;
    point.normal[axis] = record.normal[axis];
  }
  return point;
}

bool haveSameBits(const Vector3& a, const Vector3& b)
{
  return std::memcmp(a.data(), b.data(), 3 * sizeof(double)) == 0;
}

/// Weights that are often at or near an edge, and sum up to 1 roughly.
Vector3 weightsInside(test::RandomVectors& random)
{
  const double s = random.uniform(0, 1), t = random.uniform(0, 1) * (1 - s);
  Vector3 weights(1 - s - t, s, t);
  if (random.engine() % 2 == 0)
  {
    weights[static_cast<int>(random.engine() % 3)] =
      random.engine() % 2 == 0 ? 0.0 : random.powerOfTwo(-50, -1);
  }
  return weights;
}

void expectSamePoints(const Triangle& triangle, test::RandomVectors& random)
{
  const SurfaceRecord record(triangle);
  for (int i = 0; i < 5; ++i)
  {
    const Vector3 weights = weightsInside(random);
    const SurfacePoint point = pointOf(record, weights), expected = surfacePoint(triangle, weights);
    ASSERT_TRUE(haveSameBits(point.position, expected.position)) << exactly(triangle);
    ASSERT_TRUE(haveSameBits(point.normal, expected.normal)) << exactly(triangle);
    ASSERT_EQ(point.clearance, expected.clearance) << exactly(triangle);
  }
}

// Law: a point that is computed of a record has the bits of SurfacePoint.
TEST(SurfaceRecord, GivesThePointsOfSurfacePoint)
{
  test::RandomVectors random(31);
  for (int i = 0; i < 50000 / test::kFewer; ++i)
  {
    const double size = random.powerOfTwo(-40, 3), far = random.powerOfTwo(-3, 20);
    const Vector3 a = far * random.inCube();
    expectSamePoints({ a, a + size * random.inCube(), a + size * random.inCube() }, random);
  }
  // Slivers, whose points are kept in the middle.
  for (const double width : { 1e-8, 1e-10, 1e-12 })
  {
    expectSamePoints({ { 1, 0, 0 }, { 2, 0, 0 }, { 1.5, width, 0 } }, random);
  }
}

TEST(SurfaceRecord, WithoutAreaHasNoNormal)
{
  const SurfaceRecord record({ { 1, 2, 3 }, { 1, 2, 3 }, { 4, 5, 6 } });
  EXPECT_TRUE(std::isnan(record.normal[0]));
  EXPECT_EQ(record.clearance, 6 * 0x1p-33);
}

/// Each record is that of the triangle in the world, and numbers follow the order of ids.
void expectRecordsOf(const NamedScene& named, const SurfaceRecords& records)
{
  const Scene scene = named.scene(TraversalMode::Sequential);
  std::uint32_t number = 0;
  for (std::uint32_t object = 0; object <= named.objects.size(); ++object)
  {
    const RigidObject& body = object == 0 ? *named.still : *named.objects[object - 1].body;
    for (std::uint32_t i = 0; i < body.mesh().size(); ++i, ++number)
    {
      const TriangleId id{ object, i };
      ASSERT_EQ(records.numbers().numberOf(id), number);
      ASSERT_EQ(records.numbers().idOf(number), id);
      const SurfaceRecord expected(scene.worldTriangle(id));
      ASSERT_EQ(std::memcmp(&records[number], &expected, sizeof expected), 0) << named.name;
    }
  }
  EXPECT_EQ(records.size(), number);
}

TEST(SurfaceRecords, AreOfTheTrianglesInTheWorld)
{
  for (const NamedScene& scene : test::testScenes())
  {
    SurfaceRecords records;
    records.update(scene.still, scene.objects);
    expectRecordsOf(scene, records);
  }
  const SurfaceRecords none;
  EXPECT_EQ(none.size(), 0u);
  EXPECT_EQ(none.numbers().numberOf({}), TriangleNumbers::kNone);
  EXPECT_EQ(none.numbers().idOf(TriangleNumbers::kNone), TriangleId());
}

// What moves, comes, goes or is replaced is made anew, also after an update that was cancelled.
TEST(SurfaceRecords, FollowTheScene)
{
  test::RandomVectors random(32);
  const std::vector<NamedScene> others = test::testScenes();
  NamedScene scene = test::hardMaps();
  SurfaceRecords records;
  for (int step = 0; step < 60; ++step)
  {
    const std::size_t object = random.engine() % scene.objects.size();
    switch (random.engine() % 5)
    {
      case 0:
        scene.objects[object].worldFromObject.translation += random.inCube();
        break;
      case 1:
        scene.objects[object].body = others[0].objects[random.engine() % 4].body;
        break;
      case 2:
        scene.still = others[random.engine() % others.size()].still;
        break;
      case 3:
        scene.objects.push_back(scene.objects[object]);
        break;
      default:
        scene.objects.erase(scene.objects.begin() + static_cast<std::ptrdiff_t>(object / 2));
        if (scene.objects.empty())
        {
          scene.objects = others[0].objects;
        }
    }
    if (step % 3 == 0)
    {
      int left = static_cast<int>(random.engine() % 3);
      const CancelPoint cancel = [&] {
        if (left-- == 0)
        {
          throw std::runtime_error("cancelled");
        }
      };
      try
      {
        records.update(scene.still, scene.objects, cancel);
      }
      catch (const std::runtime_error&)
      {
        scene.objects[0].worldFromObject.translation += random.inCube();
      }
    }
    records.update(scene.still, scene.objects);
    expectRecordsOf(scene, records);
  }
}

TEST(SurfaceRecords, AreLeftAloneWhereNothingChanged)
{
  NamedScene scene = test::hardMaps();
  SurfaceRecords records;
  records.update(scene.still, scene.objects);
  // A mark in each object shows whether its records were made again.
  std::vector<std::uint32_t> marked;
  for (std::uint32_t object = 0; object <= scene.objects.size(); ++object)
  {
    marked.push_back(records.numbers().first(object));
    const_cast<SurfaceRecord&>(records[marked.back()]).clearance = -1;
  }
  scene.objects[2].worldFromObject.translation[0] += 0.5;
  records.update(scene.still, scene.objects);
  for (std::uint32_t object = 0; object < marked.size(); ++object)
  {
    EXPECT_EQ(records[marked[object]].clearance == -1, object != 3) << object;
  }
}

}
}
