// SPDX-License-Identifier: BSD-3-Clause
#include "../RayCasting/TestMeshes.h"
#include "BounceFront.h"
#include "Kit.h"

// Law: what is stored of a segment on the grid is within 1/2 + kBlur of it, and what is cut off is
// outside the grid's inner part; the same bits on every instruction set.

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
    placeOnGrid(grid, front.columns().rays, 0, front.size(), segments);
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
      placeOnGrid(grid, front.columns().rays, 0, front.size(), segments);
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
  placeOnGrid(grid, columns.rays, 0, front.size(), together);
  for (std::size_t i = 0; i < front.size(); ++i)
  {
    GridSegments alone;
    placeOnGrid(grid, columns.rays, i, 1, alone);
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
    placeOnGrid(grid, front.columns().rays, 0, front.size(), segments);
    placeOnGrid(scaledGrid, scaledFront.columns().rays, 0, front.size(), scaled);
    EXPECT_EQ(std::memcmp(&segments, &scaled, sizeof scaled), 0);
  }
}

}
}
