// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/FrontCast.h"

#include "TestFronts.h"
#include "TestRays.h"
#include "TestScenes.h"
#include "TestSimdLevels.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

// Attacks the margins with which a front prepares rays in floats: where they enter the tree's box, how
// late, and how nearly along it.

namespace irradiance
{
namespace
{

using test::exactly;
using test::RandomVectors;
using test::Triangles;

/// Tiny triangles in the faces of a box, along its edges and in its corners, in all orientations: a ray
/// that begins a little too late in the box has passed them. A few large ones make the tree deep.
Triangles crumbsInFaces(RandomVectors& random, double size)
{
  Triangles triangles;
  for (int i = 0; i < 240; ++i)
  {
    Vector3 place = random.inCube();
    const int faces = i % 8 == 0 ? 3 : i % 4 == 0 ? 2 : 1;
    for (int axis = 0; axis < faces; ++axis)
    {
      // Within their own size of the face, so that they reach it.
      place[(i + axis) % 3] = random.uniform() < 0 ? -1 : 1;
    }
    const auto corner = [&] { return Vector3((place + size * random.inCube()).cwiseMax(-1).cwiseMin(1)); };
    const Vector3 a = corner(), b = corner(), c = corner();
    triangles.push_back({ a, b, c });
  }
  return triangles;
}

/// From some distance, at a point of a triangle or just beside it; often nearly along an axis, or nearly
/// in a face of the box.
Ray attack(const Triangles& triangles, RandomVectors& random)
{
  const Triangle& triangle = triangles[random.engine() % triangles.size()];
  const double s = random.uniform(0, 1), t = random.uniform(0, 1) * (1 - s);
  Vector3 target = (1 - s - t) * triangle.a + s * triangle.b + t * triangle.c;
  Vector3 direction = random.direction();
  const auto axis = static_cast<int>(random.engine() % 3);
  switch (random.engine() % 4)
  {
    case 0: // nearly along an axis, about as nearly as floats follow
      direction = Vector3::Unit(axis) + random.powerOfTwo(-13, -6) * random.inCube();
      break;
    case 1: // along a face, in which most targets lie
      direction[axis] = random.uniform() * random.powerOfTwo(-12, -8);
      break;
    case 2: // at a corner
      target = random.engine() % 2 == 0 ? triangle.a : triangle.c;
      break;
    default:
      break;
  }
  if (random.uniform() < 0)
  {
    direction = -direction;
  }
  Ray ray = test::asInFront({ target, direction, {} });
  // Beyond 2^8 others prepare the rays.
  ray.origin -= random.powerOfTwo(-1, 8.5) * ray.direction;
  return ray;
}

/// The number of rays whose hits are not those that Scene finds, which prepares them in double.
int mismatches(RandomVectors& random, int rays)
{
  constexpr std::uint32_t kFront = 4000;
  const double size = random.powerOfTwo(-20, -4);
  const AffineMap place{ Matrix3::Identity(),
    random.engine() % 2 == 0 ? Vector3(Vector3::Zero()) : Vector3(1e3 * random.inCube()) };
  const Triangles crumbs = test::moved(crumbsInFaces(random, size), place);
  const bool isBody = random.engine() % 3 == 0;
  test::NamedScene named{ "", test::bodyOf(isBody ? Triangles{} : crumbs), {} };
  if (isBody)
  {
    named.objects.push_back({ test::bodyOf(crumbsInFaces(random, size)),
      { random.powerOfTwo(-8, 8) * random.rotation(), Vector3(random.inCube()) } });
  }
  const Scene scene = named.scene(TraversalMode::Sequential);
  SurfaceRecords records;
  records.update(named.still, named.objects);
  Triangles world;
  for (std::uint32_t i = 0; i < records.size(); ++i)
  {
    world.push_back(scene.worldTriangle(records.idOf(i)));
  }
  const double extent = isBody ? named.objects[0].worldFromObject.linear.col(0).norm() : 1;
  std::vector<Ray> batch(kFront);
  std::vector<Hit> expected(kFront);
  test::TestFront front(records);
  FrontCast cast;
  int wrong = 0;
  for (int first = 0; first < rays; first += static_cast<int>(kFront))
  {
    for (Ray& ray : batch)
    {
      ray = attack(world, random);
      const Vector3 center = place.translation;
      // As far away relative to a body as to the box.
      ray.origin = isBody ? Vector3(ray.origin + (extent - 1) * (ray.origin - world[0].a)) : ray.origin;
      (void)center;
    }
    scene.cast(batch.data(), batch.size(), expected.data());
    front.set(batch, std::vector<Hit>(kFront));
    cast.cast(scene, records, front.columns());
    for (std::size_t i = 0; i < batch.size(); ++i)
    {
      const Hit found = front.hit(i);
      if (found != expected[i] && ++wrong == 1)
      {
        ADD_FAILURE() << exactly(batch[i]) << "\n  expected " << exactly(expected[i]) << "\n  found "
                      << exactly(found) << ", triangles of " << size;
      }
    }
  }
  return wrong;
}

}
}
