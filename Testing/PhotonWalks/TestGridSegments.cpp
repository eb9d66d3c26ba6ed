// SPDX-License-Identifier: BSD-3-Clause
// Law: what is stored of a segment on the grid is within 1/2 + kBlur of it, and what is cut off is
// outside the grid's inner part; the same bits on every instruction set.

#include "../RayCasting/TestMeshes.h"
#include "BounceFront.h"
#include "History/PageScan.h"
#include "Kit.h"

namespace irradiance::test
{
namespace
{

using Exact = long double;
using ExactVector = Eigen::Matrix<Exact, 3, 1>;

constexpr Exact kTolerance = 0.5L + Exact(GridSegments::kBlur);

/// A grid of any size and place, flat or not.
PointGrid randomGrid(RandomVectors& random)
{
  const double unit = random.powerOfTwo(-40, 40);
  const Vector3 center = unit * random.powerOfTwo(-10, 20) * random.direction();
  const Vector3 half = unit *
    Vector3(1, random.powerOfTwo(-14, 0), random.uniform() > 0.8 ? 0 : random.powerOfTwo(-3, 0));
  return PointGrid(box(center - half, center + half));
}

/// Some are whole, some begin or end far outside, some escape or run along an axis.
BounceSegment randomSegment(RandomVectors& random, const PointGrid& grid)
{
  BounceSegment segment;
  const double far = random.uniform() > 0.5 ? random.powerOfTwo(0, 31) : 1;
  segment.origin = grid.world(PointGrid::kReach * far * random.inCube());
  const double aim = random.uniform() > 0.7 ? random.powerOfTwo(0, 10) : 1;
  const Vector3 to = grid.world(PointGrid::kReach * aim * random.inCube());
  segment.direction = (to - segment.origin).normalized().cast<float>();
  segment.distance = random.uniform() > 0.6 ? kInfinity : (to - segment.origin).norm();
  if (random.uniform() > 0.9)
  {
    segment.direction = Eigen::Vector3f::Unit(static_cast<int>(random.uniform(0, 3)));
  }
  return segment;
}

BounceFront randomFront(RandomVectors& random, const PointGrid& grid, std::size_t size)
{
  BounceFront front;
  while (front.size() < size)
  {
    front.add(randomSegment(random, grid));
  }
  return front;
}

struct ExactRay
{
  ExactVector origin, along; ///< on the grid

  ExactRay(const PointGrid& grid, const BounceSegment& segment)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      origin[axis] =
        (Exact(segment.origin[axis]) - Exact(grid.center[axis])) / Exact(grid.step[axis]);
      along[axis] = Exact(segment.direction[axis]) / Exact(grid.step[axis]);
    }
  }
  ExactVector at(Exact t) const { return origin + t * along; }

  /// Where the ray is within `reach` of 0, between 0 and `end`; from > to if nowhere.
  std::pair<Exact, Exact> span(Exact reach, Exact end) const
  {
    Exact from = 0, to = end;
    for (int axis = 0; axis < 3; ++axis)
    {
      const Exact a = (-reach - origin[axis]) / along[axis],
                  b = (reach - origin[axis]) / along[axis];
      if (along[axis] == 0)
      {
        to = std::abs(origin[axis]) > reach ? -1 : to;
        continue;
      }
      from = std::max(from, std::min(a, b));
      to = std::min(to, std::max(a, b));
    }
    return { from, to };
  }
};

ExactVector storedEnd(const GridSegments& segments, std::size_t i, int first)
{
  const auto end = [&](std::size_t axis) {
    return static_cast<long double>(segments.ends[first + axis][i]);
  };
  return { end(0), end(1), end(2) };
}

/// How far, along the worst axis, p is from the stored segment, at the same share of its length.
Exact offStored(const ExactVector& p, const ExactVector& a, const ExactVector& b)
{
  const ExactVector along = b - a;
  Exact best = (p - a).cwiseAbs().maxCoeff();
  // The share is not known: the best of many near the foot of p.
  const Exact foot = along.squaredNorm() > 0 ? (p - a).dot(along) / along.squaredNorm() : Exact(0);
  for (int i = -20; i <= 20; ++i)
  {
    const Exact share =
      std::clamp<Exact>(foot + Exact(i) / (20 * std::max<Exact>(along.norm(), 1)), 0, 1);
    best = std::min(best, (p - a - share * along).cwiseAbs().maxCoeff());
  }
  return best;
}

/// Whatever of the segment lies in the inner part of the grid is where it is stored.
void expectStored(
  const PointGrid& grid, const BounceSegment& segment, const GridSegments& segments, std::size_t i)
{
  const ExactRay ray(grid, segment);
  const auto state = static_cast<GridSegments::State>(segments.states[i]);
  const ExactVector a = storedEnd(segments, i, 0), b = storedEnd(segments, i, 3);
  if (state == GridSegments::Whole)
  {
    ASSERT_LE((ray.at(0) - a).cwiseAbs().maxCoeff(), kTolerance);
    ASSERT_LE((ray.at(segment.distance) - b).cwiseAbs().maxCoeff(), kTolerance);
    return;
  }
  ASSERT_TRUE(ray.origin.cwiseAbs().maxCoeff() < Exact(GridSegments::kFarthest) ||
    state == GridSegments::TooFar);
  const auto [from, to] = ray.span(GridSegments::kInner, segment.distance);
  for (const Exact share : { 0.0L, 0.3L, 0.5L, 0.9L, 1.0L })
  {
    if (from <= to && state == GridSegments::Cut)
    {
      ASSERT_LE(offStored(ray.at(from + share * (to - from)), a, b), kTolerance + 0.001L);
    }
  }
}

TEST(GridSegments, AreWhereTheSegmentsAre)
{
  RandomVectors random(1);
  int counts[3] = {}, inside = 0;
  for (int round = 0; round < 2000 / kFewer; ++round)
  {
    const PointGrid grid = randomGrid(random);
    BounceFront front = randomFront(random, grid, GridSegments::kSize - 3);
    GridSegments segments;
    bounceLoops().placeOnGrid(grid, front.columns().rays, 0, front.size(), segments);
    for (std::size_t i = 0; i < front.size(); ++i)
    {
      ASSERT_NO_FATAL_FAILURE(expectStored(grid, front[i], segments, i))
        << "round " << round << ", segment " << i;
      ++counts[segments.states[i]];
      const auto [from, to] =
        ExactRay(grid, front[i]).span(GridSegments::kInner, front[i].distance);
      inside += segments.states[i] == GridSegments::Cut && from <= to ? 1 : 0;
    }
  }
  for (const int count : counts)
  {
    EXPECT_GT(count, 1000 / kFewer);
  }
  EXPECT_GT(inside, 10000 / kFewer);
}

TEST(GridSegments, AreTheSameOnEveryInstructionSet)
{
  RandomVectors random(2);
  for (int round = 0; round < 200 / kFewer; ++round)
  {
    const PointGrid grid = randomGrid(random);
    BounceFront front = randomFront(random, grid, GridSegments::kSize);
    GridSegments first;
    for (const SimdLevel level : simdLevels())
    {
      const SimdLimit limit(level);
      GridSegments segments;
      bounceLoops().placeOnGrid(grid, front.columns().rays, 0, front.size(), segments);
      first = level == SimdLevel::Plain ? segments : first;
      ASSERT_EQ(std::memcmp(&segments, &first, sizeof first), 0);
    }
  }
}

// A ray may be stored alone or beside others: neighbours that escape change nothing.
TEST(GridSegments, DoNotDependOnTheirNeighbours)
{
  RandomVectors random(3);
  const PointGrid grid = randomGrid(random);
  BounceFront front = randomFront(random, grid, GridSegments::kSize);
  const BounceColumns columns = front.columns();
  GridSegments together;
  bounceLoops().placeOnGrid(grid, columns.rays, 0, front.size(), together);
  for (std::size_t i = 0; i < front.size(); ++i)
  {
    GridSegments alone;
    bounceLoops().placeOnGrid(grid, columns.rays, i, 1, alone);
    EXPECT_EQ(alone.states[0], together.states[i]);
    for (int column = 0; column < 6; ++column)
    {
      EXPECT_EQ(alone.ends[column][0], together.ends[column][i]);
    }
  }
}

// Law 6: a scene scaled by a power of two is stored in the same bits.
TEST(GridSegments, ScaleWithTheScene)
{
  RandomVectors random(4);
  const Vector3 lower(-3, 1, 5), upper(4, 2, 6);
  for (const double scale : { 0x1p-30, 0x1p50 })
  {
    const PointGrid grid(box(lower, upper)), scaledGrid(box(scale * lower, scale * upper));
    BounceFront front = randomFront(random, grid, GridSegments::kSize), scaledFront;
    for (std::size_t i = 0; i < front.size(); ++i)
    {
      BounceSegment segment = front[i];
      segment.origin *= scale;
      segment.distance *= scale;
      scaledFront.add(segment);
    }
    GridSegments segments, scaled;
    bounceLoops().placeOnGrid(grid, front.columns().rays, 0, front.size(), segments);
    bounceLoops().placeOnGrid(scaledGrid, scaledFront.columns().rays, 0, front.size(), scaled);
    EXPECT_EQ(std::memcmp(&segments, &scaled, sizeof scaled), 0);
  }
}

// Law: the grid of an ordinary scene holds all of it; what is far away makes no grid coarse.

const Vector3 kFarAway(600, 0, 800); ///< 1 km
const Box kRoom = box({ 0, 0, 0 }, { 4, 4, 3 });

/// A room, a lamp and a ball that may move.
struct Room
{
  ObjectBuilder still;
  std::vector<SceneObject> dynamicObjects;
  Box lights;

  explicit Room(int cells = 1) { still.addBox(kRoom, cells, grey(0.5), true); }

  void addBall(const Vector3& place, double radius, int n)
  {
    dynamicObjects.push_back(ball(place, radius, n));
  }

  SceneObjects objects() const { return { still.build(), dynamicObjects }; }
  Box bounds() const
  {
    Box bounds = lights;
    const SceneObjects all = objects();
    for (std::uint32_t i = 0; i < all.size(); ++i)
    {
      bounds.add(all[i].worldBounds());
    }
    return bounds;
  }
  PointGrid grid() const { return pointGrid(objects(), bounds()); }
};

bool isSame(const PointGrid& a, const PointGrid& b)
{
  return a.center == b.center && a.step == b.step;
}

bool holds(const PointGrid& grid, const Box& box)
{
  return grid(box.lower).cwiseAbs().maxCoeff() <= PointGrid::kReach &&
    grid(box.upper).cwiseAbs().maxCoeff() <= PointGrid::kReach;
}

/// The steps are at most this length.
void expectRoom(const PointGrid& grid, double step)
{
  EXPECT_TRUE(holds(grid, kRoom));
  EXPECT_LE(grid.step.maxCoeff(), step);
}

TEST(PointGrid, HoldsAllOfAnOrdinaryRoom)
{
  for (const int cells : { 1, 2, 7 })
  {
    Room room(cells);
    room.addBall({ 2, 2, 1 }, 0.3, 6);
    EXPECT_TRUE(isSame(room.grid(), PointGrid(kRoom))) << cells;
    // Many small triangles in one place, and things beside the house.
    room.addBall({ 1, 1, 1 }, 0.02, 60);
    room.addBall({ 20, 2, 1 }, 0.3, 6);
    room.lights.add(Vector3(2, 30, 3));
    EXPECT_TRUE(isSame(room.grid(), PointGrid(room.bounds()))) << cells;
  }
}

TEST(PointGrid, IsFineWhereSomethingIsFarAway)
{
  for (const double distances : { 1.0, 1e2, 1e6, 1e12 })
  {
    Room light, lamp, vehicle;
    light.lights.add(distances * kFarAway);
    lamp.still.addQuad(distances * kFarAway, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1, grey(0, 1));
    // Has more triangles than the room, and less area.
    vehicle.addBall(distances * kFarAway, 1.5, 20);
    for (Room* room : { &light, &lamp, &vehicle })
    {
      room->addBall({ 3, 3, 1 }, 0.3, 6);
      expectRoom(room->grid(), 2e-3);
    }
  }
}

TEST(PointGrid, HoldsDynamicObjectsThatAreNear)
{
  Room room;
  room.lights.add(kFarAway);
  room.addBall({ 40, 2, 1 }, 0.3, 6); // farther than the room is cut otherwise
  const PointGrid grid = room.grid();
  expectRoom(grid, 2e-3);
  EXPECT_TRUE(holds(grid, room.objects().dynamicObjects[0].worldBounds()));
  room.dynamicObjects[0].isPresent = false;
  EXPECT_FALSE(isSame(room.grid(), grid));
}

TEST(PointGrid, HoldsWhatIsThere)
{
  // Only far things: these are what matters.
  Room far;
  far.still = ObjectBuilder();
  far.addBall(kFarAway, 0.3, 6);
  EXPECT_TRUE(isSame(far.grid(), PointGrid(far.bounds())));
  // No surface.
  Room lights;
  lights.still = ObjectBuilder();
  EXPECT_TRUE(isSame(lights.grid(), PointGrid(Box())));
  lights.lights.add(kFarAway);
  EXPECT_TRUE(isSame(lights.grid(), PointGrid(lights.lights)));
  // A floor, and a far light above it.
  Room floor;
  floor.still = ObjectBuilder();
  floor.still.addQuad({ 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 1, 1, grey(0.5));
  EXPECT_TRUE(isSame(floor.grid(), PointGrid(floor.bounds())));
  floor.lights.add(Vector3(1, 1, 1e4));
  const PointGrid grid = floor.grid();
  EXPECT_TRUE(holds(grid, box({ 0, 0, 0 }, { 4, 4, 0 })));
  EXPECT_LE(grid.step.maxCoeff(), 1e-3);
}

TEST(PointGrid, FollowsTheScaleOfTheScene)
{
  Room room;
  room.addBall(kFarAway, 0.3, 6);
  const SceneObjects objects = room.objects();
  const PointGrid grid = pointGrid(objects, room.bounds());
  for (const double scale : { 0x1p-100, 0x1p100 })
  {
    std::vector<Triangle> triangles;
    for (const Triangle& triangle : objects.staticObject.mesh().triangles())
    {
      triangles.push_back({ scale * triangle.a, scale * triangle.b, scale * triangle.c });
    }
    SceneObjects scaled = objects;
    scaled.staticObject.body = std::make_shared<RigidObject>(TriangleMesh(triangles));
    AffineMap& pose = scaled.dynamicObjects[0].worldFromObject;
    pose.linear *= scale;
    pose.translation *= scale;
    const Box bounds = room.bounds();
    const PointGrid other = pointGrid(scaled, { scale * bounds.lower, scale * bounds.upper });
    EXPECT_EQ(other.center, Vector3(scale * grid.center));
    EXPECT_EQ(other.step, Vector3(scale * grid.step));
  }
}

}
}
