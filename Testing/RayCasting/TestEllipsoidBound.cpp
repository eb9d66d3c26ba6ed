// SPDX-License-Identifier: BSD-3-Clause
#include "Ellipsoids/EllipsoidBound.h"

#include "AdversarialSegments.h"
#include "ExactSegmentTriangle.h"
#include "QuadGeometry.h"
#include "RandomVectors.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

namespace irradiance
{
namespace
{

using exact::Quad;
using exact::Touch;
using test::Body;
using test::Motion;
using test::RandomVectors;
using test::Segment;
using test::SegmentSource;

struct Count
{
  long segments = 0;
  long rejected = 0;
  long falselyRejected = 0;
  long flat = 0; ///< rejected ones that lie in the plane of their triangle: left undecided

  Count& operator+=(const Count& other)
  {
    segments += other.segments;
    rejected += other.rejected;
    falselyRejected += other.falselyRejected;
    flat += other.flat;
    return *this;
  }
};

Count fuzz(
  const Body& body, const AffineMap& map, const EnclosingEllipsoid& ellipsoid, int n, unsigned seed)
{
  const EllipsoidBound bound(ellipsoid, body.bounds, map, 0.0);
  SegmentSource source(body, map, seed);
  Count count;
  for (int i = 0; i < n; ++i)
  {
    const Segment s = source.next();
    ++count.segments;
    if (bound.rejects(s.from, s.to))
    {
      ++count.rejected;
      const Touch touch = exact::touch(map, body.triangles[s.target], s.from, s.to);
      count.falselyRejected += touch == Touch::Yes ? 1 : 0;
      count.flat += touch == Touch::Flat ? 1 : 0;
    }
  }
  return count;
}

const Box kHuge = [] {
  Box box;
  box.add(Vector3::Constant(-1e30));
  box.add(Vector3::Constant(1e30));
  return box;
}();

}

// Law: the ellipsoid never rejects a segment that hits the body.
TEST(EllipsoidBound, RejectsNoSegmentThatHits)
{
  const std::vector<Body> bodies = test::hardBodies();
  const std::vector<Motion> motions = test::hardMotions();
  constexpr int kPerPair = 84000 / test::kFewer;
  Count total;
  unsigned seed = 1000;
  for (const Motion& motion : motions)
  {
    for (const Body& body : bodies)
    {
      const Count count = fuzz(body, motion.worldFromObject, body.ellipsoid, kPerPair, ++seed);
      EXPECT_EQ(count.falselyRejected, 0) << motion.name << ", " << body.name;
      total += count;
    }
  }
  EXPECT_GE(total.segments, 10000000 / test::kFewer);
  EXPECT_GE(total.rejected, total.segments / 50);
  EXPECT_LE(total.flat, total.rejected / 1000);
}

// The test above can fail: nearly every pair detects an ellipsoid that is too small by 1e-4.
TEST(EllipsoidBound, FuzzFindsARadiusTooSmall)
{
  unsigned seed = 2000;
  for (const Body& body : test::hardBodies())
  {
    EnclosingEllipsoid tooSmall = body.ellipsoid;
    tooSmall.shape /= 0.9999;
    Count count;
    for (const Motion& motion : test::hardMotions())
    {
      count += fuzz(body, motion.worldFromObject, tooSmall, 5000, ++seed);
    }
    EXPECT_GT(count.falselyRejected, 0) << body.name;
  }
}

// Segments end exactly on a corner whose image is exact in doubles.
TEST(EllipsoidBound, RejectsNoSegmentThatEndsOnACorner)
{
  RandomVectors random(3);
  const auto integer = [&] { return std::floor(random.uniform(-8, 9)); };
  for (int repeat = 0; repeat < 20000; ++repeat)
  {
    AffineMap map; // often singular
    std::vector<Vector3> corners;
    for (int i = 0; i < 3; ++i)
    {
      map.linear.row(i) = Vector3(integer(), integer(), integer()) * (repeat % 3 == i ? 0 : 1);
      map.translation[i] = integer();
      corners.push_back({ integer(), integer(), integer() });
    }
    Box box;
    for (const Vector3& corner : corners)
    {
      box.add(corner);
    }
    const EllipsoidBound bound(encloseByEllipsoid(corners), box, map, 0.0);
    for (const Vector3& corner : corners)
    {
      const Vector3 image = map(corner);
      const Vector3 other = image + random.direction() * random.powerOfTwo(-20, 20);
      EXPECT_FALSE(bound.rejects(image, other) || bound.rejects(other, image));
      EXPECT_FALSE(bound.rejects(image, image));
    }
  }
}

TEST(EllipsoidBound, RejectsNoSegmentWithinThePad)
{
  RandomVectors random(4);
  long tests = 0;
  for (const Motion& motion : test::hardMotions())
  {
    for (const Body& body : test::hardBodies())
    {
      const AffineMap& map = motion.worldFromObject;
      const double size = (map.linear * body.ellipsoid.shape.inverse()).norm();
      const double pad = size * random.powerOfTwo(-40, 1);
      const EllipsoidBound bound(body.ellipsoid, body.bounds, map, pad);
      for (int i = 0; i < 3000; ++i)
      {
        const auto& [triangle, k] = body.contacts[i % body.contacts.size()];
        const Vector3& corner = body.triangles[triangle][k];
        const Vector3 offset = random.direction();
        const Vector3 along = offset.cross(random.direction()).normalized();
        const Vector3 x = map(corner) + offset * pad * random.uniform(0.999999, 1.0);
        const double before = i % 5 == 0 ? 0.0 : size * random.powerOfTwo(-10, 10);
        const double after = size * random.powerOfTwo(-10, 10);
        const Vector3 from = x - before * along;
        const Vector3 to = x + after * along;
        const bool rejected = bound.rejects(from, to);
        const bool isWithin =
          exact::squaredDistance(exact::moved(map, corner), from, to) <= Quad(pad) * Quad(pad);
        tests += isWithin ? 1 : 0;
        EXPECT_FALSE(rejected && isWithin) << motion.name << ", " << body.name;
      }
    }
  }
  EXPECT_GE(tests, 100000);
}

TEST(EllipsoidBound, PadIsNotMuchWiderThanAsked)
{
  const Body body = test::sphere(12);
  for (const double pad : { 1e-9, 1e-3, 1.0, 1e3 })
  {
    RandomVectors random(9);
    const EllipsoidBound bound(body.ellipsoid, body.bounds, {}, pad);
    for (int i = 0; i < 1000; ++i)
    {
      const Vector3 up = random.direction();
      const Vector3 along = up.cross(random.direction());
      const Vector3 x = (1.01 + 1.75 * pad) * up; // sqrt(3) at worst
      EXPECT_TRUE(bound.rejects(x - along, x + 2.0 * along)) << pad;
    }
  }
}

// On ordinary segments it rejects as often as the exact ellipsoid would.
TEST(EllipsoidBound, RejectsNearlyAllThatMiss)
{
  RandomVectors random(5);
  for (const Motion& motion : test::hardMotions())
  {
    if (!motion.hasInverse)
    {
      continue; // nothing to compare with
    }
    for (const Body& body : test::hardBodies())
    {
      const EllipsoidBound bound(body.ellipsoid, body.bounds, motion.worldFromObject, 0.0);
      const Matrix3 semiAxes = motion.worldFromObject.linear * body.ellipsoid.shape.inverse();
      const Matrix3 unitFromWorld = semiAxes.inverse();
      const Vector3 center = motion.worldFromObject(body.ellipsoid.center);
      const double size = semiAxes.norm();
      long rejected = 0;
      long missing = 0;
      for (int i = 0; i < 20000; ++i)
      {
        const double far = i % 10 == 0 ? 1e3 : 2.0;
        const Vector3 from = center + 2.0 * size * random.inCube();
        const Vector3 to = center + far * size * random.inCube();
        const Vector3 a = unitFromWorld * (from - center);
        const Vector3 d = unitFromWorld * (to - from);
        const double t = std::clamp(-a.dot(d) / d.squaredNorm(), 0.0, 1.0);
        missing += (a + t * d).norm() > 1.0 ? 1 : 0;
        rejected += bound.rejects(from, to) ? 1 : 0;
      }
      const double ratio = static_cast<double>(rejected) / static_cast<double>(missing);
      EXPECT_GE(ratio, 0.998) << motion.name << ", " << body.name;
    }
  }
}

TEST(EllipsoidBound, BoxContainsTheEllipsoid)
{
  RandomVectors random(6);
  const std::vector<Body> bodies = test::hardBodies();
  const std::vector<Motion> motions = test::hardMotions();
  long violations = 0;
  double loosest = 0.0;
  for (int repeat = 0; repeat < 1400; ++repeat)
  {
    for (const Motion& motion : motions)
    {
      const Body& body = bodies[repeat % bodies.size()];
      AffineMap map = motion.worldFromObject;
      map.linear *= random.rotation();
      map.translation += random.inCube() * 1e-3;
      const Box box = EllipsoidBound(body.ellipsoid, kHuge, map, 0.0).worldBox();
      const exact::QuadEllipsoid truth(body.ellipsoid, map);
      const Quad roundingUnit = 1e-15 * map.translation.norm() +
        1e-15 *
          (map.linear.norm() *
            (body.ellipsoid.center.norm() + body.ellipsoid.shape.inverse().norm()));
      for (int i = 0; i < 3; ++i)
      {
        const Quad square = truth.squaredHalfWidth(i);
        const Quad below = truth.center[i] - Quad(box.lower[i]);
        const Quad above = Quad(box.upper[i]) - truth.center[i];
        for (const Quad reach : { below, above })
        {
          violations += reach < 0 || reach * reach < square ? 1 : 0;
          const Quad excess = (reach * reach - square) / (reach * roundingUnit);
          loosest = std::max(loosest, static_cast<double>(excess));
        }
      }
    }
  }
  EXPECT_EQ(violations, 0);
  EXPECT_LE(loosest, 200.0) << "in units of 1e-15 of the coordinates";
}

TEST(EllipsoidBound, BoxContainsTheBodyAndIsTight)
{
  RandomVectors random(7);
  long tests = 0;
  long violations = 0;
  for (const Body& body : test::hardBodies())
  {
    double areaRatio = 0.0;
    int n = 0;
    for (const Motion& motion : test::hardMotions())
    {
      for (int repeat = 0; repeat < 6; ++repeat)
      {
        AffineMap map = motion.worldFromObject;
        map.linear *= random.rotation();
        const double pad = repeat % 2 == 0 ? 0.0 : 1e-9 * map.linear.norm();
        const Box box = EllipsoidBound(body.ellipsoid, body.bounds, map, pad).worldBox();
        Box measured;
        for (const auto& triangle : body.triangles)
        {
          for (const Vector3& corner : triangle)
          {
            const exact::Vector<Quad> x = exact::moved(map, corner);
            for (int i = 0; i < 3; ++i)
            {
              ++tests;
              violations +=
                x[i] - Quad(pad) < Quad(box.lower[i]) || x[i] + Quad(pad) > Quad(box.upper[i]);
            }
            measured.add(map(corner));
          }
        }
        const auto area = [](const Box& b) {
          const Vector3 e = b.extent();
          return e[0] * e[1] + e[1] * e[2] + e[2] * e[0];
        };
        if (motion.name == "rotation")
        {
          areaRatio += area(box) / area(measured);
          ++n;
        }
      }
    }
    EXPECT_LE(areaRatio / n, 1.6) << body.name;
  }
  EXPECT_GE(tests, 300000);
  EXPECT_EQ(violations, 0);
}

TEST(EllipsoidBound, AcceptsWhatItCannotJudge)
{
  const Body body = test::box();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const EllipsoidBound bound(body.ellipsoid, body.bounds, {}, 0.0);
  EXPECT_TRUE(bound.rejects({ 9, 9, 9 }, { 9, 9, -9 }));
  EXPECT_TRUE(bound.rejects({ 9, 9, 9 }, { 9, 9, 9 }));
  for (const double bad : { nan, kInfinity, -kInfinity, 1e300, -1e308 })
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      Vector3 end(9, 9, 9);
      end[axis] = bad;
      EXPECT_FALSE(bound.rejects(end, -end)) << bad;
      if (!(std::abs(bad) < kInfinity))
      {
        EXPECT_FALSE(bound.rejects(end, { 9, 9, 9 })) << bad;
        EXPECT_FALSE(bound.rejects({ 9, 9, 9 }, end)) << bad;
      }
    }
    AffineMap map;
    map.linear(1, 2) = std::abs(bad) < kInfinity ? nan : bad;
    const EllipsoidBound unknown(body.ellipsoid, body.bounds, map, 0.0);
    EXPECT_FALSE(unknown.rejects({ 9, 9, 9 }, { 9, 9, 10 }));
    EXPECT_EQ(unknown.worldBox().lower[0], -kInfinity);
    EXPECT_EQ(unknown.worldBox().upper[2], kInfinity);
  }
  EXPECT_TRUE(EllipsoidBound(body.ellipsoid, Box{}, {}, 1.0).worldBox().isEmpty());
}

TEST(EllipsoidBound, ScalesExactlyWithPowersOfTwo)
{
  for (const Body& body : test::hardBodies())
  {
    for (const Motion& motion : test::hardMotions())
    {
      const AffineMap& map = motion.worldFromObject;
      const double pad = 1e-12 * map.linear.norm();
      const EllipsoidBound unit(body.ellipsoid, body.bounds, map, pad);
      for (const int exponent : { -60, -7, 1, 40 })
      {
        const double s = std::ldexp(1.0, exponent);
        const EnclosingEllipsoid ellipsoid{ body.ellipsoid.center * s, body.ellipsoid.shape / s };
        const Box box{ body.bounds.lower * s, body.bounds.upper * s };
        const EllipsoidBound scaled(ellipsoid, box, { map.linear, map.translation * s }, pad * s);
        EXPECT_TRUE(scaled.worldBox().lower == unit.worldBox().lower * s) << motion.name;
        EXPECT_TRUE(scaled.worldBox().upper == unit.worldBox().upper * s) << motion.name;
        SegmentSource source(body, map, 8);
        for (int i = 0; i < 300; ++i)
        {
          const Segment g = source.next();
          EXPECT_EQ(scaled.rejects(g.from * s, g.to * s), unit.rejects(g.from, g.to));
        }
      }
    }
  }
}

}
