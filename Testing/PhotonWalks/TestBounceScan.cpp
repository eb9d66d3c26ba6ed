// SPDX-License-Identifier: BSD-3-Clause
#include "../RayCasting/TestScenes.h"
#include "BounceFront.h"
#include "History/BounceScan.h"
#include "Kit.h"

// Law: however far the ends of a segment and the body are from each other and from the grid, a
// segment that touches a body is flagged, the same ones on every instruction set, and few others
// are.

namespace irradiance::test
{
namespace
{

using Exact = long double;
using ExactVector = Eigen::Matrix<Exact, 3, 1>;
using ExactMatrix = Eigen::Matrix<Exact, 3, 3>;
using Slots = std::vector<std::uint32_t>;

/// Calls find() with each instruction set; all find the same, which is returned.
template <class Find>
auto foundByAll(const Find& find)
{
  std::vector<decltype(find())> found;
  for (const SimdLevel level : simdLevels())
  {
    const SimdLimit limit(level);
    found.push_back(find());
    EXPECT_EQ(found.back(), found.front()) << "SIMD level " << static_cast<int>(level);
  }
  return found.front();
}

/// Segments of walks of their own, in a block.
class Stored
{
public:
  Stored(BounceFront& front, const PointGrid& grid)
    : arena_(BounceBlock::pageBytes(1))
    , block_(arena_, 0, static_cast<std::uint32_t>(front.size()), 1, grid, {})
  {
    front.appendTo(block_);
  }

  /// As each instruction set finds them, which is the same.
  Slots flaggedBy(const BounceScan& scan) const
  {
    return foundByAll([&] {
      Slots slots;
      scan.find(block_, block_, slots);
      return slots;
    });
  }
  BounceBlock& block() { return block_; }

private:
  BlockArena arena_;
  BounceBlock block_;
};

bool has(const Slots& slots, std::size_t slot)
{
  return std::binary_search(slots.begin(), slots.end(), static_cast<std::uint32_t>(slot));
}

EllipsoidBound boundOf(const RigidObject& body, const AffineMap& pose)
{
  return EllipsoidBound(body.ellipsoid(), body.mesh().bounds(), pose, 0);
}

OwnBox boxOf(const RigidObject& body, const AffineMap& pose)
{
  return { body.mesh().bounds(), pose, 0 };
}

/// A body in a grid; the body may be flat, and far from the grid's centre.
struct Placed
{
  PointGrid grid;
  AffineMap pose;
  double unit;

  explicit Placed(RandomVectors& random, double slenderest = 12)
    : unit(random.powerOfTwo(-30, 30))
  {
    const Vector3 center = unit * random.powerOfTwo(-10, 12) * random.direction();
    const Vector3 half = unit * Vector3(1, random.powerOfTwo(-8, 0), random.powerOfTwo(-2, 0));
    grid = PointGrid(box(center - half, center + half));
    const Vector3 lengths(1, random.powerOfTwo(-slenderest, 0), random.powerOfTwo(-3, 0));
    pose.linear = unit * random.powerOfTwo(-12, -2) * random.rotation() * lengths.asDiagonal() *
      random.rotation();
    const double away = random.uniform() > 0.6 ? random.powerOfTwo(0, 6) : 0.7;
    pose.translation = center + away * half.cwiseProduct(random.inCube());
  }

  /// Through `point`, or nearly so, along `way`, perhaps just up to it; from near or far, or to
  /// nowhere.
  BounceSegment through(RandomVectors& random, const Vector3& point, const Vector3& way) const
  {
    const auto length = [&] {
      return random.uniform() > 0.5 ? 0.0 : unit * random.powerOfTwo(-12, 8);
    };
    BounceSegment segment;
    segment.direction = way.normalized().cast<float>();
    const double before = length();
    segment.origin = point - before * segment.direction.cast<double>();
    segment.distance = random.uniform() > 0.6 ? kInfinity : before + length() + 1e-9 * unit;
    return segment;
  }
};

double nearlyOne(RandomVectors& random)
{
  return 1 - random.uniform() * random.powerOfTwo(-30, -22);
}

/// Distance of the segment from the centre of a ball, in the space where the body's bound is round.
Exact distanceFrom(const EllipsoidBound::Ball& ball, const BounceSegment& segment)
{
  const ExactMatrix map = ball.roundFromWorld.cast<Exact>();
  const ExactVector p = map * (segment.origin.cast<Exact>() - ball.center.cast<Exact>());
  const ExactVector q = map * segment.direction.cast<Exact>();
  const Exact place = std::clamp<Exact>(-p.dot(q) / q.squaredNorm(), 0, segment.distance);
  return (p + place * q).norm();
}

/// Whether a point `before` from where the segment begins lies in the body's own box.
bool isInBox(const OwnBox& own, const BounceSegment& segment, Exact before)
{
  const ExactVector world = segment.origin.cast<Exact>() + before * segment.direction.cast<Exact>();
  const ExactVector point = own.worldFromObject.linear.cast<Exact>().inverse() *
    (world - own.worldFromObject.translation.cast<Exact>());
  return (point.array() >= own.box.lower.cast<Exact>().array()).all() &&
    (point.array() <= own.box.upper.cast<Exact>().array()).all();
}

/// Segments that touch the ball from outside, or nearly so, somewhere along them or with an end.
BounceSegment grazing(RandomVectors& random, const EllipsoidBound::Ball& ball, const Placed& placed)
{
  const Matrix3 worldFromRound = ball.roundFromWorld.inverse();
  const Vector3 normal = random.direction();
  const Vector3 point = ball.center + worldFromRound * (ball.radius * nearlyOne(random) * normal);
  return placed.through(random, point, worldFromRound * normal.cross(random.direction()));
}

std::shared_ptr<const RigidObject> cube()
{
  return bodyOf(boxOfCells(Vector3::Constant(-1), Vector3::Constant(1), { 1, 1, 1 }));
}

/// A point on an edge of the cube, perhaps a corner of it.
Vector3 onEdge(RandomVectors& random)
{
  Vector3 point = random.inCube().array().sign();
  if (random.uniform() > 0)
  {
    point[static_cast<int>(random.uniform(0, 3))] = random.uniform();
  }
  return point * (1 - random.powerOfTwo(-40, -22));
}

/// Each in a walk of its own.
void addWalk(BounceFront& front, BounceSegment segment)
{
  segment.walk = static_cast<std::uint32_t>(front.size());
  front.add(segment);
}

BounceSegment aimed(const Vector3& from, const Vector3& to, bool escapes)
{
  BounceSegment segment;
  segment.origin = from;
  segment.direction = (to - from).normalized().cast<float>();
  segment.distance = escapes ? kInfinity : (to - from).norm();
  return segment;
}

/// Segments between points at random within `reach` of the origin along each axis.
BounceFront randomFront(RandomVectors& random, int count, double reach)
{
  BounceFront front;
  while (front.size() < static_cast<std::size_t>(count))
  {
    const Vector3 from = reach * random.inCube();
    addWalk(front, aimed(from, reach * random.inCube(), false));
  }
  return front;
}

/// Whether it touches the ball.
bool touches(const EllipsoidBound::Ball& ball, const BounceSegment& segment)
{
  return distanceFrom(ball, segment) <= Exact(ball.radius);
}

/// A grid around the origin, with the same step along all axes.
PointGrid cubicGrid(double half)
{
  return PointGrid(box(Vector3::Constant(-half), Vector3::Constant(half)));
}

/// A place that rounding moves by nearly half a step along each axis, to where `away` points.
Vector3 worstNear(const Vector3& place, const Vector3& away)
{
  const double most = 0.4999;
  return place.array().round() - most * away.array().sign();
}

/// None of the segments that touch a body is missed; returns how many do.
template <class Touches>
int expectNoneMissed(BounceFront& front, const PointGrid& grid, const EllipsoidBound& bound,
  const OwnBox* own, const Touches& touches)
{
  const Stored stored(front, grid);
  BounceScan scan(grid);
  scan.addBody(bound, own);
  const Slots flagged = stored.flaggedBy(scan);
  int count = 0;
  for (std::size_t i = 0; i < front.size(); ++i)
  {
    const bool isTouching = touches(i);
    EXPECT_TRUE(!isTouching || has(flagged, i)) << "segment " << i;
    count += isTouching ? 1 : 0;
  }
  return count;
}

TEST(BounceScan, NoneThatTouchesABallIsMissed)
{
  RandomVectors random(1);
  const auto ball = bodyOf(icosphere(1));
  int touching = 0, all = 0;
  for (int round = 0; round < 600 / kFewer; ++round)
  {
    const Placed placed(random);
    const EllipsoidBound bound = boundOf(*ball, placed.pose);
    BounceFront front;
    for (int i = 0; i < 1000; ++i)
    {
      addWalk(front, grazing(random, bound.ball(), placed));
    }
    touching += expectNoneMissed(front, placed.grid, bound, nullptr,
      [&](std::size_t i) { return touches(bound.ball(), front[i]); });
    all += static_cast<int>(front.size());
  }
  EXPECT_GT(touching, 100000 / kFewer);
  EXPECT_GT(all - touching, 100000 / kFewer) << "all but touching";
}

TEST(BounceScan, NoneThatTouchesABoxIsMissed)
{
  RandomVectors random(2);
  const auto body = cube();
  int touching = 0;
  for (int round = 0; round < 600 / kFewer; ++round)
  {
    const Placed placed(random);
    const OwnBox own = boxOf(*body, placed.pose);
    BounceFront front;
    std::vector<Exact> before;
    for (int i = 0; i < 1000; ++i)
    {
      const Vector3 point = onEdge(random);
      // Along a tangent in the cube's space, or anyhow.
      const Vector3 way =
        random.uniform() > 0 ? point.cross(random.direction()) : random.direction();
      addWalk(front, placed.through(random, placed.pose(point), placed.pose.linear * way));
      const Vector3 along = front[front.size() - 1].direction.cast<double>();
      before.push_back(
        (placed.pose(point) - front[front.size() - 1].origin).dot(along) / along.squaredNorm());
    }
    touching +=
      expectNoneMissed(front, placed.grid, boundOf(*body, placed.pose), &own, [&](std::size_t i) {
        return isInBox(own, front[i], std::clamp<Exact>(before[i], 0, front[i].distance));
      });
  }
  EXPECT_GT(touching, 100000 / kFewer);
}

// The blur: an end that touches a small ball, and is rounded away from it as far as may be.
TEST(BounceScan, RoundingToTheGridIsPaidFor)
{
  RandomVectors random(3);
  const auto ball = bodyOf(icosphere(1));
  const PointGrid grid = cubicGrid(4);
  int touching = 0;
  for (int round = 0; round < 3000 / kFewer; ++round)
  {
    // Nearly along a diagonal, where roundings along all axes add up.
    const Vector3 normal =
      (Vector3(random.inCube().array().sign()) + 0.1 * random.inCube()).normalized();
    const Vector3 end = grid.world(worstNear(PointGrid::kReach * 0.9 * random.inCube(), normal));
    AffineMap pose;
    pose.linear = random.powerOfTwo(-12, -1) * Matrix3::Identity();
    // Away from `end` along the normal, by the radius there.
    const EllipsoidBound::Ball at0 = boundOf(*ball, pose).ball();
    const double radius = at0.radius / (at0.roundFromWorld * normal).norm() * nearlyOne(random);
    pose.translation = end - radius * normal - at0.center;
    const EllipsoidBound bound = boundOf(*ball, pose);
    BounceFront front;
    for (int i = 0; i < 4; ++i)
    {
      const Vector3 tangent = normal.cross(random.direction());
      addWalk(
        front, aimed(end, end + random.powerOfTwo(-10, 1) * (0.2 * i * normal + tangent), i == 3));
    }
    touching += expectNoneMissed(
      front, grid, bound, nullptr, [&](std::size_t i) { return touches(bound.ball(), front[i]); });
  }
  EXPECT_GT(touching, 4000 / kFewer);
}

// The same for the corner of a box.
TEST(BounceScan, RoundingBesideABoxIsPaidFor)
{
  RandomVectors random(4);
  const auto body = cube();
  const PointGrid grid = cubicGrid(4);
  int touching = 0;
  for (int round = 0; round < 3000 / kFewer; ++round)
  {
    AffineMap pose;
    pose.linear = random.rotation() *
      Vector3(random.powerOfTwo(-9, 0), random.powerOfTwo(-9, 0), 0.5).asDiagonal() *
      (round % 2 == 0 ? Matrix3(Matrix3::Identity()) : random.rotation());
    const Vector3 corner = Vector3(random.inCube().array().sign());
    const Vector3 normal = pose.linear.inverse().transpose() * corner;
    const Vector3 end = grid.world(worstNear(PointGrid::kReach * 0.5 * random.inCube(), normal));
    pose.translation = end - pose.linear * corner * (1 - 0x1p-40);
    const OwnBox own = boxOf(*body, pose);
    BounceFront front;
    for (int i = 0; i < 4; ++i)
    {
      const Vector3 tangent = normal.cross(random.direction()).normalized();
      addWalk(front, aimed(end, end + random.powerOfTwo(-10, 1) * tangent, i == 3));
    }
    touching += expectNoneMissed(front, grid, boundOf(*body, pose), &own,
      [&](std::size_t i) { return isInBox(own, front[i], 0); });
  }
  EXPECT_GT(touching, 6000 / kFewer);
}

// Each segment that is flagged without need costs a ray. The body is in a room of 4 m, segments
// come from there and from up to 10^9 m away; some escape.
TEST(BounceScan, FewOthersAreFlagged)
{
  RandomVectors random(5);
  const auto ball = bodyOf(icosphere(3));
  const PointGrid grid = cubicGrid(2);
  for (const double away : { 0.0, 1e3, 1e5, 1e9 })
  {
    for (const bool escapes : { false, true })
    {
      int touching = 0, flagged = 0;
      for (int round = 0; round < 20; ++round)
      {
        const AffineMap pose{ 0.2 * Matrix3::Identity(), 1.7 * random.inCube() };
        const EllipsoidBound bound = boundOf(*ball, pose);
        const OwnBox own = boxOf(*ball, pose);
        BounceFront front;
        for (int i = 0; i < 1024; ++i)
        {
          const Vector3 from = 2 * random.inCube() + away * Vector3(0.6, 0, 0.8);
          const Vector3 to = 2 * random.inCube();
          BounceSegment segment = aimed(from, to, escapes);
          // Floats of a direction do not suffice to aim from that far.
          segment.origin = to - (to - from).norm() * segment.direction.cast<double>();
          addWalk(front, segment);
        }
        BounceScan scan(grid);
        scan.addBody(bound, &own);
        flagged += static_cast<int>(Stored(front, grid).flaggedBy(scan).size());
        for (std::size_t i = 0; i < front.size(); ++i)
        {
          touching += touches(bound.ball(), front[i]) ? 1 : 0;
        }
      }
      EXPECT_GT(touching, 50);
      EXPECT_LT(flagged, 1.02 * touching + 3) << away << (escapes ? ", escapes" : "");
    }
  }
}

// An ellipsoid around a box is 2.7 times as large.
TEST(BounceScan, TheOwnBoxOfABodyFlagsFewer)
{
  RandomVectors random(6);
  const auto body = cube();
  const PointGrid grid = cubicGrid(2);
  std::size_t byBound = 0, byBox = 0;
  for (int round = 0; round < 40; ++round)
  {
    AffineMap pose{ 0.2 * random.rotation(), 1.7 * random.inCube() };
    pose.linear.col(1) *= 0.01;
    const OwnBox own = boxOf(*body, pose);
    BounceFront front = randomFront(random, 1024, 2);
    Stored stored(front, grid);
    BounceScan round1(grid), box(grid);
    round1.addBody(boundOf(*body, pose));
    box.addBody(boundOf(*body, pose), &own);
    const Slots more = stored.flaggedBy(round1), fewer = stored.flaggedBy(box);
    EXPECT_TRUE(std::includes(more.begin(), more.end(), fewer.begin(), fewer.end()));
    byBound += more.size();
    byBox += fewer.size();
  }
  EXPECT_LT(double(byBox), 0.8 * double(byBound));
}

// Of bodies that are small beside the grid, balls are tested first; there may be larger ones as
// well.
TEST(BounceScan, ManyBodiesFlagWhatEachFlagsAlone)
{
  RandomVectors random(11);
  const auto ball = bodyOf(icosphere(1));
  const PointGrid grid(box({ -1, 1.3, 2 }, { 3, 2.7, 4 }));
  std::size_t count = 0;
  for (int round = 0; round < 20; ++round)
  {
    BounceFront front;
    for (int i = 0; i < 1024; ++i)
    {
      const Vector3 from(1 + 2 * random.uniform(), 2, 3), to(1, 2 + 0.7 * random.uniform(), 3);
      addWalk(front, aimed(from + 0.7 * random.inCube(), to + random.inCube(), i % 5 == 0));
    }
    Stored stored(front, grid);
    BounceScan all(grid);
    std::set<std::uint32_t> any;
    for (int body = 0; body < 30; ++body)
    {
      const Vector3 lengths(1, random.powerOfTwo(-3, 0), random.powerOfTwo(-3, 0));
      const AffineMap pose{ random.powerOfTwo(-6, round % 2 == 0 ? -4 : -1) * random.rotation() *
          lengths.asDiagonal(),
        Vector3(1, 2, 3) + 0.6 * random.inCube() };
      const OwnBox own = boxOf(*ball, pose);
      BounceScan alone(grid);
      alone.addBody(boundOf(*ball, pose), &own);
      all.addBody(boundOf(*ball, pose), &own);
      const Slots its = stored.flaggedBy(alone);
      any.insert(its.begin(), its.end());
    }
    const Slots found = stored.flaggedBy(all);
    EXPECT_TRUE(std::equal(found.begin(), found.end(), any.begin(), any.end())) << round;
    count += found.size();
  }
  EXPECT_GT(count, 1000u);
}

// What is not whole within the grid is flagged for a body that is not.
TEST(BounceScan, BodiesOutsideTheGrid)
{
  RandomVectors random(7);
  const auto ball = bodyOf(icosphere(1));
  const PointGrid grid = cubicGrid(2);
  BounceFront front;
  for (int i = 0; i < 1000; ++i)
  {
    addWalk(front, aimed(3 * random.inCube(), 3 * random.inCube(), random.uniform() > 0.5));
  }
  Stored stored(front, grid);
  for (const double place : { 0.0, 1.7, 1.85, 1.9, 5.0, 1e6 })
  {
    BounceScan scan(grid);
    scan.addBody(boundOf(*ball, { 0.15 * Matrix3::Identity(), { 0, place, 0 } }));
    const Slots flagged = stored.flaggedBy(scan);
    const bool isOutside = place > 1.86; // the grid has a small margin
    for (std::uint32_t i = 0; i < front.size(); ++i)
    {
      const bool isOpen = (stored.block().tag(i) & BounceTag::kOpen) != 0;
      ASSERT_TRUE(!(isOutside && isOpen) || has(flagged, i));
    }
    EXPECT_TRUE(isOutside || flagged.size() < front.size() / 4);
  }
}

TEST(BounceScan, WhatEndsOnAMovedObjectIsFlagged)
{
  RandomVectors random(8);
  const PointGrid grid = cubicGrid(2);
  BounceFront front;
  for (int i = 0; i < 1024; ++i)
  {
    BounceSegment segment = aimed(3 * random.inCube(), 3 * random.inCube(), i % 7 == 0);
    segment.kind =
      i % 11 == 0 ? BounceColumns::kContact : BounceTag::kindOf(static_cast<std::uint32_t>(i));
    addWalk(front, segment);
  }
  BounceSegment lost = aimed({ 1e30, 0, 0 }, { 1, 1, 1 }, false);
  front.add(lost); // of walk 0, whose segment it replaces
  Stored stored(front, grid);
  for (int round = 0; round < 20; ++round)
  {
    BounceScan scan(grid);
    std::set<std::uint8_t> moved;
    for (int i = 0; i < round; ++i)
    {
      const auto object = static_cast<std::uint32_t>(random.uniform(1, 300));
      scan.addMoved(object);
      moved.insert(BounceTag::kindOf(object));
    }
    const Slots flagged = stored.flaggedBy(scan);
    for (std::uint32_t i = 1; i < 1024; ++i)
    {
      const std::uint8_t kind = front[i].kind;
      ASSERT_EQ(has(flagged, i), moved.count(kind) > 0 || kind == BounceColumns::kContact) << i;
    }
    EXPECT_TRUE(has(flagged, 0));
    stored.block().removeFrom(static_cast<std::uint32_t>(round) * 11);
    Slots none;
    scan.find(stored.block(), stored.block(), none);
    EXPECT_FALSE(has(none, static_cast<std::uint32_t>(round) * 11))
      << "free slots are never flagged";
    BounceSegment again = front[static_cast<std::size_t>(round) * 11];
    BounceFront one;
    one.add(again);
    one.appendTo(stored.block());
  }
}

TEST(BounceScan, AllAreFlaggedWhereFloatsTellTooLittle)
{
  RandomVectors random(9);
  const PointGrid grid = cubicGrid(2);
  BounceFront front = randomFront(random, 1000, 2);
  Stored stored(front, grid);
  const auto ball = bodyOf(icosphere(0));
  for (const double size : { 1e-30, std::numeric_limits<double>::quiet_NaN() })
  {
    BounceScan scan(grid);
    scan.addBody(boundOf(*ball, { size * Matrix3::Identity(), { 0, 0, 0 } }));
    EXPECT_EQ(stored.flaggedBy(scan).size(), front.size()) << size;
  }
}

/// A body in two ways: that of a ball counts if it is small.
struct TestedBody
{
  GridBody body;
  GridBall ball = {};
};

/// Whether a segment alone in a page is flagged for a body.
bool isFlagged(const BouncePage& page, const TestedBody& tested)
{
  const BouncePage* const pages[] = { &page };
  constexpr float kStretch[] = { 1, 0.7F, 0.1F };
  std::uint16_t flagged[PageScan::kGroups];
  NearBody near[PageScan::kMostParts];
  const PageScan scan{ pages, 1, nullptr, {}, &tested.body, &tested.ball, 1, tested.ball.isSmall(),
    kStretch, near, flagged };
  bounceLoops().scanPages(scan);
  return (flagged[0] & 1) != 0;
}

/// The least float with which `make(float)` is a body for which the segment is flagged.
template <class Make>
float leastThatFlags(const BouncePage& page, const Make& make)
{
  // Of floats above 0, the order is that of their bits.
  const auto floatOf = [](std::uint32_t bits) {
    float value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  };
  constexpr std::uint32_t kInfinityBits = 0x7f800000u;
  std::uint32_t no = 0, yes = kInfinityBits;
  while (yes - no > 1)
  {
    const std::uint32_t middle = no + (yes - no) / 2;
    (isFlagged(page, make(floatOf(middle))) ? yes : no) = middle;
  }
  return floatOf(yes);
}

GridBody randomBody(RandomVectors& random)
{
  GridBody body{};
  const auto fill = [&](float* values, int count, double size) {
    std::generate_n(values, count, [&] { return static_cast<float>(size * random.uniform()); });
  };
  fill(body.matrix, 9, 1e-3);
  fill(body.offset, 3, 30);
  fill(body.boxMatrix, 9, 1e-3);
  fill(body.boxOffset, 3, 30);
  return body;
}

BouncePage randomPage(RandomVectors& random)
{
  BouncePage page{};
  std::fill(std::begin(page.tags), std::end(page.tags), BounceTag::kFree);
  page.tags[0] = 0;
  for (auto& column : page.ends)
  {
    column[0] = static_cast<std::int16_t>(PointGrid::kReach * random.uniform());
  }
  return page;
}

// On the edge of being flagged, one rounding makes the difference.
TEST(BounceScan, EveryInstructionSetRoundsTheSame)
{
  RandomVectors random(10);
  for (int round = 0; round < 500 / kFewer; ++round)
  {
    const BouncePage page = randomPage(random);
    GridBody body = randomBody(random);
    foundByAll([&] {
      return leastThatFlags(page, [&](float radius) {
        body.squaredRadius = radius;
        return TestedBody{ body };
      });
    });
    body.squaredRadius = kInfinity;
    GridBall ball;
    std::generate_n(
      ball.center, 3, [&] { return static_cast<float>(PointGrid::kReach * random.uniform()); });
    foundByAll([&] {
      return leastThatFlags(page, [&](float radius) {
        ball.squaredRadius = radius;
        return TestedBody{ body, ball };
      });
    });
    body.hasBox = true;
    std::fill_n(body.slack, 3, 1e30f);
    foundByAll([&] {
      return leastThatFlags(page, [&](float face) {
        std::fill_n(body.face, 3, face);
        return TestedBody{ body };
      });
    });
    std::fill_n(body.face, 3, 1e30f);
    foundByAll([&] {
      return leastThatFlags(page, [&](float slack) {
        std::fill_n(body.slack, 3, slack);
        return TestedBody{ body };
      });
    });
  }
}

/// Segments that all but touch a ball, some from inside. Their lines lie in a plane of two axes, so
/// that they pass the ball along the third, where nothing hides what rounding does.
BouncePage pageBeside(RandomVectors& random, const GridBall& ball, const Vector3& stretch)
{
  BouncePage page{};
  const double radius = std::sqrt(static_cast<double>(ball.squaredRadius));
  for (std::size_t i = 0; i < BouncePage::kSize; ++i)
  {
    const int a = static_cast<int>(i % 3), b = (a + 1) % 3;
    const double angle = random.uniform(-3.2, 3.2), c = std::cos(angle), s = std::sin(angle);
    const double away = radius * (1 + 0.01 * random.uniform());
    for (int end = 0; end < 2; ++end)
    {
      Vector3 place(ball.center[0], ball.center[1], ball.center[2]);
      const double along = (1 - 2 * end) * PointGrid::kReach * random.powerOfTwo(-5, 0);
      place[a] += along * c - away * s;
      place[b] += along * s + away * c;
      for (int axis = 0; axis < 3; ++axis)
      {
        const double most = PointGrid::kReach;
        page.ends[3 * end + axis][i] = static_cast<std::int16_t>(
          std::min(std::max(std::round(place[axis] / stretch[axis]), -most), most));
      }
    }
  }
  return page;
}

std::vector<std::uint16_t> flaggedIn(
  const BouncePage& page, const GridBall& ball, const Vector3& stretch)
{
  const BouncePage* const pages[] = { &page };
  // The same one so often that lines are tested; but for its ball it has no say.
  constexpr std::uint32_t kBodies = 16;
  GridBody body{};
  body.squaredRadius = kInfinity;
  const std::vector<GridBody> bodies(kBodies, body);
  const std::vector<GridBall> balls(kBodies, ball);
  const Eigen::Vector3f stretches = stretch.cast<float>();
  std::vector<std::uint16_t> flagged(PageScan::kGroups);
  NearBody near[PageScan::kMostParts * kBodies];
  const PageScan scan{ pages, 1, nullptr, {}, bodies.data(), balls.data(), kBodies, ball.isSmall(),
    stretches.data(), near, flagged.data() };
  bounceLoops().scanPages(scan);
  return flagged;
}

TEST(BounceScan, LinesLoseNoSegmentThatComesNearABall)
{
  RandomVectors random(11);
  const auto sphere = bodyOf(icosphere(2));
  int few = 0, all = 0;
  for (int round = 0; round < 2000 / kFewer; ++round)
  {
    const Vector3 half(1, random.powerOfTwo(-3, 0), random.powerOfTwo(-3, 0));
    const PointGrid grid(box(-half, half));
    const Vector3 stretch = grid.step / grid.step.maxCoeff();
    const AffineMap pose{ random.powerOfTwo(-12, -5) * random.rotation(),
      1.1 * half.cwiseProduct(random.inCube()) };
    GridBall ball = ballOnGrid(grid, boundOf(*sphere, pose));
    const BouncePage page = pageBeside(random, ball, stretch);
    const GridBall withLines = ball;
    ball.lineRadius = GridBall().lineRadius;
    const auto flagged = foundByAll([&] { return flaggedIn(page, ball, stretch); });
    EXPECT_EQ(foundByAll([&] { return flaggedIn(page, withLines, stretch); }), flagged)
      << "round " << round;
    for (const std::uint16_t group : flagged)
    {
      few += __builtin_popcount(group);
      all += 16;
    }
  }
  EXPECT_GT(few, all / 5);
  EXPECT_LT(few, all / 5 * 4);
}

}
}
