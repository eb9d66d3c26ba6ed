// SPDX-License-Identifier: BSD-3-Clause
#include "../RayCasting/SingleRays.h"
#include "../RayCasting/TestScenes.h"
#include "../RayCasting/TestSimdLevels.h"
#include "History/SegmentScan.h"
#include "Scene/Scene.h"
#include "ShotWalk.h"

#include <gtest/gtest.h>

#include <set>

// Law: a scan flags every segment that a moved object changes.

namespace irradiance
{

namespace
{

using test::WalkSegment;

constexpr std::uint32_t kWalksOfOne = 400;

/// A block of random walks in a box, and what they were made of.
struct RandomWalks
{
  RandomWalks(test::RandomVectors& random, const Vector3& center, double size)
    : frame(boxAround(center, size))
    , block(0, kWalksOfOne, 1, frame, {})
  {
    for (std::uint32_t walk = 0; walk < kWalksOfOne; ++walk)
    {
      walks.push_back(makeWalk(random, center, size));
      test::replaceTail(block, { walk, 0 }, walks[walk], frame);
    }
  }

  static Box boxAround(const Vector3& center, double size)
  {
    Box box;
    box.add(Vector3(center.array() - size));
    box.add(Vector3(center.array() + size));
    return box;
  }

  /// Up to five segments, each from where the one before ended; some escape.
  static std::vector<WalkSegment> makeWalk(
    test::RandomVectors& random, const Vector3& center, double size)
  {
    std::vector<WalkSegment> walk;
    Vector3 from = center + size * random.inCube();
    const int segments = 1 + static_cast<int>(random.uniform(0, 5));
    for (int i = 0; i < segments; ++i)
    {
      const Vector3 to = center + size * random.inCube();
      WalkSegment segment;
      segment.ray = { from, (to - from).normalized(), {} };
      if (i + 1 < segments || random.uniform() > 0)
      {
        segment.hit.distance = (to - from).norm();
        segment.hit.id = { static_cast<std::uint32_t>(random.uniform(0, 4)), 0 };
      }
      walk.push_back(segment);
      from = to;
    }
    return walk;
  }

  std::set<std::pair<std::uint32_t, std::uint32_t>> flaggedBy(const SegmentScan& scan) const
  {
    std::vector<std::uint32_t> points;
    scan.find(block, block, points);
    std::set<std::pair<std::uint32_t, std::uint32_t>> flagged;
    for (const std::uint32_t point : points)
    {
      if (const auto segment = block.segmentAt(point))
      {
        flagged.insert({ segment->walk, segment->bounce });
      }
    }
    return flagged;
  }

  UnitFrame frame;
  WalkBlock block;
  std::vector<std::vector<WalkSegment>> walks;
};

struct Counts
{
  int segments = 0, touched = 0, missed = 0, flagged = 0;
};

/// One object that moved, at a random place in or around the box.
Counts scanOne(test::RandomVectors& random, const std::shared_ptr<const RigidObject>& body,
  const AffineMap& pose, const RandomWalks& walks)
{
  Scene scene;
  scene.setDynamic({ { body, pose } });
  scene.setPointSources(RandomWalks::boxAround(walks.frame.center, 2 / walks.frame.scale));
  scene.commit({ true });
  SegmentScan scan(walks.frame, 4);
  scan.addBody(scene.shadowBound(0));
  const std::uint32_t movedObject = 2;
  scan.addMoved(movedObject);
  Counts counts;
  const auto flagged = walks.flaggedBy(scan);
  counts.flagged = static_cast<int>(flagged.size());
  for (std::uint32_t walk = 0; walk < walks.walks.size(); ++walk)
  {
    for (std::uint32_t bounce = 0; bounce < walks.walks[walk].size(); ++bounce)
    {
      const WalkSegment& segment = walks.walks[walk][bounce];
      ++counts.segments;
      const bool endsOnMoved = segment.hit.id.object == movedObject;
      const bool isBlocked =
        test::castMoved(scene, segment.ray, Hit{ segment.hit.distance, { 0, 0 } }).id.object == 1;
      counts.touched += isBlocked || endsOnMoved ? 1 : 0;
      counts.missed += (isBlocked || endsOnMoved) && flagged.count({ walk, bounce }) == 0 ? 1 : 0;
    }
  }
  (void)random;
  return counts;
}

Matrix3 randomShape(test::RandomVectors& random, double size)
{
  // Round, flat or needle-like in any direction, now and then mirrored.
  const Vector3 lengths(
    random.powerOfTwo(-3, 0), random.powerOfTwo(-12, 0), random.powerOfTwo(-3, 0));
  Matrix3 shape = random.rotation() * lengths.asDiagonal() * random.rotation();
  if (random.uniform() > 0.8)
  {
    shape.row(0) *= -1;
  }
  return size * shape;
}

}

TEST(SegmentScan, NamesEverySegmentThatAMovedObjectChanges)
{
  constexpr unsigned kSeed = 1;
  test::RandomVectors random(kSeed);
  const auto ball = test::bodyOf(test::icosphere(1));
  for (const SimdLevel level : test::simdLevels())
  {
    const test::SimdLimit limit(level);
    Counts all;
    for (int round = 0; round < 300 / test::kFewer; ++round)
    {
      const double size = random.powerOfTwo(-30, 30);
      const Vector3 center = size * random.powerOfTwo(-10, 12) * random.direction();
      const RandomWalks walks(random, center, size);
      AffineMap pose;
      pose.linear = randomShape(random, size * random.powerOfTwo(-6, 0));
      pose.translation = center + 1.2 * size * random.inCube();
      const Counts counts = scanOne(random, ball, pose, walks);
      all.touched += counts.touched;
      all.missed += counts.missed;
      ASSERT_EQ(counts.missed, 0) << "seed " << kSeed << ", round " << round << ", SIMD level "
                                  << static_cast<int>(level);
    }
    EXPECT_GT(all.touched, 10000 / test::kFewer);
  }
}

// Each segment that is flagged without need costs a ray.
TEST(SegmentScan, NamesFewOthers)
{
  test::RandomVectors random(2);
  const auto ball = test::bodyOf(test::icosphere(3));
  for (const double radius : { 0.02, 0.1, 0.4 })
  {
    Counts all;
    for (int round = 0; round < 40; ++round)
    {
      const RandomWalks walks(random, { 100, 200, 300 }, 8);
      const AffineMap pose{ 8 * radius * Matrix3::Identity(),
        Vector3(100, 200, 300) + 4 * random.inCube() };
      const Counts counts = scanOne(random, ball, pose, walks);
      all.flagged += counts.flagged;
      all.touched += counts.touched;
    }
    EXPECT_LT(all.flagged, 1.1 * all.touched) << "radius " << radius;
  }
}

TEST(SegmentScan, NamesAllWhereFloatsTellTooLittle)
{
  test::RandomVectors random(3);
  const RandomWalks walks(random, { 0, 0, 0 }, 1);
  std::size_t segments = 0;
  for (const auto& walk : walks.walks)
  {
    segments += walk.size();
  }
  EXPECT_EQ(walks.flaggedBy(SegmentScan(walks.frame, 1e9)).size(), segments);
  EXPECT_EQ(walks.flaggedBy(SegmentScan(walks.frame, 4)).size(), 0u);
  Scene scene;
  AffineMap flat;
  flat.linear = Matrix3::Zero();
  scene.setDynamic({ { test::bodyOf(test::icosphere(0)), flat } });
  scene.commit({ true });
  SegmentScan scan(walks.frame, 4);
  for (int i = 0; i < 100; ++i)
  {
    scan.addBody(scene.shadowBound(0)); // too flat for the floats of a scan
  }
  EXPECT_EQ(walks.flaggedBy(scan).size(), segments);
}

}
