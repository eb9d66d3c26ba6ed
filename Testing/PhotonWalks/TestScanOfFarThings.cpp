// SPDX-License-Identifier: BSD-3-Clause
#include "../RayCasting/TestScenes.h"
#include "../RayCasting/TestSimdLevels.h"
#include "History/SegmentScan.h"
#include "ShotWalk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <set>

// Law: however far the ends of a segment, the body and the frame's origin are from each other, a
// segment that touches a body is flagged, and few others are.

namespace irradiance
{

namespace
{

using test::WalkSegment;

using Exact = long double;
using ExactVector = Eigen::Matrix<Exact, 3, 1>;

/// A walk of one segment; an infinite length is an escape.
struct Segment
{
  Vector3 from, direction;
  double length;
};

/// Distance of the segment from the centre of a ball, in the space where the body's bound is round.
Exact distanceFrom(const EllipsoidBound::Ball& ball, const Segment& segment)
{
  const Eigen::Matrix<Exact, 3, 3> map = ball.roundFromWorld.cast<Exact>();
  const ExactVector p = map * (segment.from - ball.center).cast<Exact>();
  const ExactVector q = map * segment.direction.cast<Exact>();
  const Exact place = std::clamp<Exact>(-p.dot(q) / q.squaredNorm(), 0, segment.length);
  return (p + place * q).norm();
}

WalkBlock store(const std::vector<Segment>& segments, const UnitFrame& frame)
{
  WalkBlock block(0, static_cast<std::uint32_t>(segments.size()), 1, frame, {});
  for (std::uint32_t walk = 0; walk < segments.size(); ++walk)
  {
    WalkSegment stored;
    stored.ray = { segments[walk].from, segments[walk].direction, {} };
    stored.hit.distance = segments[walk].length;
    stored.hit.id = segments[walk].length < kInfinity ? TriangleId{ 0, 0 } : TriangleId{};
    test::replaceTail(block, { walk, 0 }, { stored }, frame);
  }
  return block;
}

std::set<std::uint32_t> flaggedIn(const WalkBlock& block, const SegmentScan& scan)
{
  std::vector<std::uint32_t> points;
  scan.find(block, block, points);
  std::set<std::uint32_t> walks;
  for (const std::uint32_t point : points)
  {
    if (const auto segment = block.segmentAt(point))
    {
      walks.insert(segment->walk);
    }
  }
  return walks;
}

EllipsoidBound boundOf(const RigidObject& body, const AffineMap& pose)
{
  return EllipsoidBound(body.ellipsoid(), body.mesh().bounds(), pose, 0);
}

double nearlyOne(test::RandomVectors& random)
{
  return 1 - random.uniform() * random.powerOfTwo(-30, -22);
}

/// A segment that touches the ball from outside, or nearly so, somewhere along it or with an end.
/// The other end is near or far, or the segment escapes.
Segment grazing(test::RandomVectors& random, const EllipsoidBound::Ball& ball, double farthest)
{
  const Matrix3 worldFromRound = ball.roundFromWorld.inverse();
  const Vector3 normal = random.direction();
  const Vector3 point = ball.center + worldFromRound * (ball.radius * nearlyOne(random) * normal);
  const Vector3 tangent = worldFromRound * normal.cross(random.direction());
  Segment segment;
  segment.direction = tangent.normalized();
  const double size = tangent.norm();
  const auto length = [&] {
    return random.uniform() > 0.5 ? 0.0 : size * random.powerOfTwo(-6, std::log2(farthest / size));
  };
  const double before = length();
  segment.from = point - before * segment.direction;
  segment.length = random.uniform() > 0.6 ? kInfinity : before + length() + 1e-6 * size;
  return segment;
}

/// The same from a given place outside the ball.
Segment grazingFrom(
  test::RandomVectors& random, const EllipsoidBound::Ball& ball, const Vector3& from)
{
  const Vector3 p = ball.roundFromWorld * (from - ball.center);
  const double radius = ball.radius * nearlyOne(random), cosine = radius / p.norm();
  const Vector3 across = p.cross(random.direction()).normalized();
  const Vector3 normal = cosine * p.normalized() + std::sqrt(1 - cosine * cosine) * across;
  const Vector3 way = ball.center + ball.roundFromWorld.inverse() * (radius * normal) - from;
  return { from, way.normalized(),
    random.uniform() > 0.6 ? kInfinity : way.norm() * random.uniform(1, 2) };
}

struct Grazed
{
  int touching = 0, missed = 0, beside = 0, flagged = 0;
};

/// Scans many grazing segments; the body may be far from the frame's origin, and may be flat.
Grazed graze(test::RandomVectors& random, const RigidObject& body)
{
  const double unit = random.powerOfTwo(-30, 30);
  UnitFrame frame;
  frame.center = unit * random.powerOfTwo(-10, 12) * random.direction();
  frame.scale = 1 / std::exp2(std::round(std::log2(unit)));
  AffineMap pose;
  const Vector3 lengths(1, random.powerOfTwo(-16, 0), random.powerOfTwo(-3, 0));
  pose.linear =
    unit * random.powerOfTwo(-16, 0) * random.rotation() * lengths.asDiagonal() * random.rotation();
  pose.translation = frame.center + unit * random.powerOfTwo(-10, 20) * random.direction();
  const EllipsoidBound bound = boundOf(body, pose);
  std::vector<Segment> segments;
  for (int i = 0; i < 500; ++i)
  {
    const Vector3 near = frame.center + unit * random.powerOfTwo(-20, 0) * random.direction();
    const bool isOutside = (bound.ball().roundFromWorld * (near - bound.ball().center)).norm() >
      1.1 * bound.ball().radius;
    segments.push_back(isOutside && i % 2 == 0 ? grazingFrom(random, bound.ball(), near)
                                               : grazing(random, bound.ball(), 0x1p20 * unit));
  }
  SegmentScan scan(frame, 0x1p22);
  scan.addBody(bound);
  const std::set<std::uint32_t> flagged = flaggedIn(store(segments, frame), scan);
  Grazed counts;
  for (std::uint32_t i = 0; i < segments.size(); ++i)
  {
    const bool touches = distanceFrom(bound.ball(), segments[i]) <= Exact(bound.ball().radius);
    counts.touching += touches ? 1 : 0;
    counts.beside += touches ? 0 : 1;
    counts.missed += touches && flagged.count(i) == 0 ? 1 : 0;
  }
  counts.flagged = static_cast<int>(flagged.size());
  return counts;
}

/// The frame of a room of 4 m at its origin, scaled for 100 km.
UnitFrame frameOfRoom()
{
  UnitFrame frame;
  frame.scale = 0x1p-17;
  return frame;
}

Vector3 inRoom(test::RandomVectors& random)
{
  return 2 * random.inCube();
}

/// From a place to one in the room, or on through it to infinity if `escapes`.
Segment aimed(test::RandomVectors& random, const Vector3& from, bool escapes)
{
  const Vector3 to = inRoom(random);
  return { from, (to - from).normalized(), escapes ? kInfinity : (to - from).norm() };
}

}

TEST(ScanOfFarThings, NoneThatTouchesIsMissed)
{
  constexpr unsigned kSeed = 5;
  test::RandomVectors random(kSeed);
  const auto ball = test::bodyOf(test::icosphere(1));
  for (const SimdLevel level : test::simdLevels())
  {
    const test::SimdLimit limit(level);
    Grazed all;
    for (int round = 0; round < 400 / test::kFewer; ++round)
    {
      const Grazed counts = graze(random, *ball);
      ASSERT_EQ(counts.missed, 0) << "seed " << kSeed << ", round " << round << ", SIMD level "
                                  << static_cast<int>(level);
      all.touching += counts.touching;
      all.beside += counts.beside;
      all.flagged += counts.flagged;
    }
    EXPECT_GT(all.touching, 50000 / test::kFewer);
    EXPECT_GT(all.beside, 50000 / test::kFewer) << "all but touching";
  }
}

// The body is in the room. Segments come from there and from up to 10^9 m away; some escape.
TEST(ScanOfFarThings, FewOthersAreFlagged)
{
  test::RandomVectors random(6);
  const auto ball = test::bodyOf(test::icosphere(3));
  const UnitFrame frame = frameOfRoom();
  for (const double away : { 0.0, 1e3, 1e5, 1e9 })
  {
    for (const bool escapes : { false, true })
    {
      int touching = 0, flagged = 0;
      for (int round = 0; round < 20; ++round)
      {
        const AffineMap pose{ 0.2 * Matrix3::Identity(), 0.9 * inRoom(random) };
        const EllipsoidBound bound = boundOf(*ball, pose);
        std::vector<Segment> segments;
        for (std::uint32_t i = 0; i < WalkPlan::kWalksPerBlock; ++i)
        {
          segments.push_back(
            aimed(random, inRoom(random) + away * Vector3(0.6, 0, 0.8), escapes && away == 0));
        }
        SegmentScan scan(frame, 0x1p22);
        scan.addBody(bound);
        flagged += static_cast<int>(flaggedIn(store(segments, frame), scan).size());
        touching += static_cast<int>(
          std::count_if(segments.begin(), segments.end(), [&](const Segment& segment) {
            return distanceFrom(bound.ball(), segment) <= Exact(bound.ball().radius);
          }));
      }
      EXPECT_GT(touching, 50);
      EXPECT_LE(flagged, 1.05 * touching + 5) << away << " m, escapes: " << escapes;
    }
  }
}

// A far body is looked for where it is: segments inside the room are not flagged.
TEST(ScanOfFarThings, FarBodiesTakeNothingOfTheRoom)
{
  test::RandomVectors random(7);
  const auto ball = test::bodyOf(test::icosphere(3));
  const UnitFrame frame = frameOfRoom();
  std::vector<Segment> segments;
  for (std::uint32_t i = 0; i < WalkPlan::kWalksPerBlock; ++i)
  {
    segments.push_back(aimed(random, inRoom(random), false));
  }
  const WalkBlock block = store(segments, frame);
  for (const double away : { 1e2, 1e3, 1e5, 1e9 })
  {
    SegmentScan scan(frame, 0x1p22);
    scan.addBody(boundOf(*ball, { 0.1 * Matrix3::Identity(), { away, 0, 0 } }));
    EXPECT_EQ(flaggedIn(block, scan).size(), 0u) << away << " m";
  }
}

TEST(ScanOfFarThings, ManyBodiesFlagWhatEachFlags)
{
  test::RandomVectors random(8);
  const auto ball = test::bodyOf(test::icosphere(2));
  const UnitFrame frame = frameOfRoom();
  std::vector<Segment> segments;
  for (std::uint32_t i = 0; i < WalkPlan::kWalksPerBlock; ++i)
  {
    segments.push_back(aimed(random, inRoom(random), false));
  }
  const WalkBlock block = store(segments, frame);
  SegmentScan together(frame, 1);
  std::set<std::uint32_t> each;
  constexpr int kMost = 128;
  for (int count = 1; count <= kMost; ++count)
  {
    const EllipsoidBound bound = boundOf(*ball, { 0.02 * Matrix3::Identity(), inRoom(random) });
    SegmentScan alone(frame, 1);
    alone.addBody(bound);
    together.addBody(bound);
    each.merge(flaggedIn(block, alone));
    if (count == 64 || count == 65 || count == kMost)
    {
      EXPECT_EQ(flaggedIn(block, together), each) << count << " bodies";
      EXPECT_LT(each.size(), segments.size() / 4);
    }
  }
  together.addBody(boundOf(*ball, { 0.02 * Matrix3::Identity(), inRoom(random) }));
  EXPECT_EQ(flaggedIn(block, together).size(), segments.size()) << "one body more than are scanned";
}

}
