// SPDX-License-Identifier: BSD-3-Clause
// Law: ray casting = brute force, bit for bit, with every traversal and every kernel, for any
// triangles, poses and rays. Bytes become a scene of up to 64 triangles and up to 32 rays.

#include "ByteReader.h"

#include "../RayCasting/TestFronts.h"
#include "../RayCasting/TestRays.h"
#include "../RayCasting/TestScenes.h"
#include "../RayCasting/TestSimdLevels.h"

#include <Eigen/SVD>

#include <cstdio>
#include <cstdlib>

namespace irradiance::fuzzing
{

namespace
{

using test::exactly;

/// What the filter accepts: see PolyDataConverter, SceneReader and Pose.
constexpr double kMostDistant = 1e30;
constexpr double kMostSingular = 1e-14;

Vector3 readPoint(ByteReader& bytes)
{
  const double x = bytes.numberWithin(kMostDistant);
  const double y = bytes.numberWithin(kMostDistant);
  return { x, y, bytes.numberWithin(kMostDistant) };
}

/// Triangles share corners, as in meshes.
test::Triangles readTriangles(ByteReader& bytes)
{
  std::vector<Vector3> points;
  for (int i = bytes.below(12); i >= 0; --i)
  {
    points.push_back(readPoint(bytes));
  }
  const auto any = [&] { return points[bytes.byte() % points.size()]; };
  test::Triangles triangles;
  for (int i = bytes.below(17); i > 0; --i)
  {
    const Vector3 a = any(), b = any();
    triangles.push_back({ a, b, any() });
  }
  return triangles;
}

AffineMap readPose(ByteReader& bytes, const Box& model)
{
  AffineMap pose;
  if (!bytes.oneIn(4))
  {
    const double reach = kMostDistant / 8 / std::max(1.0, model.magnitude());
    for (int i = 0; i < 9; ++i)
    {
      pose.linear(i / 3, i % 3) = bytes.numberWithin(reach);
    }
    const Eigen::JacobiSVD<Matrix3> svd(pose.linear);
    if (!(svd.singularValues()[2] > kMostSingular * svd.singularValues()[0]))
    {
      pose.linear.setIdentity();
    }
  }
  pose.translation = readPoint(bytes) / 2;
  return pose;
}

test::NamedScene readScene(ByteReader& bytes)
{
  test::NamedScene scene{ "fuzzed", test::bodyOf(readTriangles(bytes)), {} };
  for (int i = bytes.below(4); i > 0; --i)
  {
    const auto body = !scene.objects.empty() && bytes.oneIn(4) ? scene.objects.back().body
                                                               : test::bodyOf(readTriangles(bytes));
    const bool isFlattened = bytes.oneIn(3);
    scene.objects.push_back({ body, readPose(bytes, body->mesh().bounds()), isFlattened });
  }
  return scene;
}

/// A corner, a point of an edge or of the inside, or any point.
Vector3 readTarget(ByteReader& bytes, const test::Triangles& triangles)
{
  if (triangles.empty() || bytes.oneIn(4))
  {
    return readPoint(bytes);
  }
  const Triangle& t = triangles[bytes.byte() % triangles.size()];
  const double u = bytes.below(5) / 4.0, v = bytes.below(5) / 4.0 * (1 - u);
  return u * t.a + v * t.b + (1 - u - v) * t.c;
}

Ray readRay(ByteReader& bytes, const test::Triangles& triangles, const std::vector<TriangleId>& ids)
{
  Ray ray;
  ray.origin = readTarget(bytes, triangles);
  ray.direction =
    bytes.oneIn(4) ? readPoint(bytes) : Vector3(readTarget(bytes, triangles) - ray.origin);
  // Of unit length, or nearly, as the rays of walks are.
  ray.direction.stableNormalize();
  if (!ids.empty() && bytes.oneIn(2))
  {
    ray.start = ids[bytes.byte() % ids.size()];
  }
  return ray;
}

/// Prints all that a test needs to repeat the case without a fuzzer.
void print(const test::NamedScene& scene)
{
  const auto printMesh = [](const char* name, const RigidObject& body) {
    std::fprintf(stderr, "%s\n", name);
    for (const Triangle& triangle : body.mesh().triangles())
    {
      std::fprintf(stderr, "  %s\n", exactly(triangle).c_str());
    }
  };
  printMesh("static", *scene.still);
  for (const PlacedBody& object : scene.objects)
  {
    printMesh(object.isFlattened ? "loose" : "rigid", *object.body);
    const AffineMap& map = object.worldFromObject;
    std::fprintf(stderr, "  columns %s %s %s, at %s\n", exactly(map.linear.col(0)).c_str(),
      exactly(map.linear.col(1)).c_str(), exactly(map.linear.col(2)).c_str(),
      exactly(map.translation).c_str());
  }
}

void compare(const test::NamedScene& scene, const char* what, SimdLevel level, const Ray& ray,
  const Hit& found, const Hit& expected)
{
  if (found != expected)
  {
    std::fprintf(stderr, "%s, kernel %d: %s\n  found    %s\n  expected %s\n", what,
      static_cast<int>(level), exactly(ray).c_str(), exactly(found).c_str(),
      exactly(expected).c_str());
    print(scene);
    std::abort();
  }
}

/// The whole scene in each mode, then the parts that verification asks for.
void compareWithBruteForce(const test::NamedScene& scene, const std::vector<Ray>& rays)
{
  Box origins;
  for (const Ray& ray : rays)
  {
    origins.add(ray.origin);
  }
  const std::size_t size = scene.objects.size();
  std::vector<bool> all(size + 1, true), moved(size), chosen(size + 1);
  for (std::size_t i = 0; i < size; i += 2)
  {
    moved[i] = chosen[i + 1] = true;
  }
  const SurfaceRecords records = scene.records();
  std::vector<Hit> closest, closestMoved;
  for (const Ray& ray : rays)
  {
    closest.push_back(bruteForce(scene, ray, all));
    closestMoved.push_back(bruteForce(scene, ray, chosen));
  }
  const char* const names[] = { "one tree", "sequential", "parallel" };
  for (const TraversalMode mode :
    { TraversalMode::OneTree, TraversalMode::Sequential, TraversalMode::Parallel })
  {
    const Scene made = scene.scene(mode, moved, origins);
    for (const SimdLevel level : test::simdLevels())
    {
      const test::SimdLimit limit(level);
      std::vector<Hit> hits(rays.size());
      made.cast(rays.data(), rays.size(), hits.data());
      const std::vector<Hit> movedHits =
        test::hitsOf(made, records, &FrontCast::castMoved, rays, std::vector<Hit>(rays.size()));
      for (std::size_t i = 0; i < rays.size(); ++i)
      {
        compare(scene, names[static_cast<int>(mode)], level, rays[i], hits[i], closest[i]);
        compare(scene, "moved", level, rays[i], movedHits[i], closestMoved[i]);
      }
    }
  }
}

void run(ByteReader bytes)
{
  const test::NamedScene scene = readScene(bytes);
  test::Triangles triangles = scene.still->mesh().triangles();
  std::vector<TriangleId> ids;
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
  {
    ids.push_back({ 0, i });
  }
  for (std::uint32_t k = 0; k < scene.objects.size(); ++k)
  {
    const PlacedBody& object = scene.objects[k];
    for (std::uint32_t i = 0; i < object.body->mesh().size(); ++i)
    {
      triangles.push_back(transformed(object.worldFromObject, object.body->mesh()[i]));
      ids.push_back({ k + 1, i });
    }
  }
  std::vector<Ray> rays;
  for (int i = 0; i < 32 && !bytes.isAtEnd(); ++i)
  {
    const Ray ray = readRay(bytes, triangles, ids);
    if (ray.direction.allFinite() && !ray.direction.isZero(0))
    {
      rays.push_back(ray);
    }
  }
  if (!rays.empty())
  {
    compareWithBruteForce(scene, rays);
  }
}

}

}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  irradiance::fuzzing::run({ data, size });
  return 0;
}
