#include "StoredSegments.h"

#include <numeric>
#include <random>

using namespace irradiance;

namespace
{

using Random = std::mt19937_64;

std::uint32_t below(std::uint32_t limit, Random& random)
{
  return static_cast<std::uint32_t>(random() % limit);
}

Vector3 pointOnWall(const Box& room, std::uint32_t wall, Random& random)
{
  std::uniform_real_distribution<double> unit;
  Vector3 point = room.lower;
  for (int axis = 0; axis < 3; ++axis)
  {
    point[axis] += unit(random) * room.extent()[axis];
  }
  const std::uint32_t axis = wall / 2;
  point[axis] = wall % 2 == 0 ? room.lower[axis] : room.upper[axis];
  return point;
}

/// From wall to wall, never along one.
std::vector<WalkSegment> makeWalk(const Box& room, Random& random)
{
  constexpr std::uint32_t kWalls = 6, kLongest = 7, kTriangles = 10000;
  std::uint32_t wall = below(kWalls, random);
  Vector3 from = pointOnWall(room, wall, random);
  std::vector<WalkSegment> walk(1 + below(kLongest, random));
  for (WalkSegment& segment : walk)
  {
    wall = (wall + 1 + below(kWalls - 1, random)) % kWalls;
    const Vector3 to = pointOnWall(room, wall, random);
    segment.ray = { from, (to - from).normalized(), {} };
    segment.hit = { (to - from).norm(), { 0, below(kTriangles, random) }, {} };
    from = to;
  }
  return walk;
}

}

StoredSegments::StoredSegments(const Box& room, std::size_t atLeast)
  : frame_(room)
{
  Random random(1);
  while (size_ < atLeast)
  {
    WalkBlock block(WalkPlan::kWalksPerBlock, 1, frame_);
    std::vector<std::vector<WalkSegment>> walks(WalkPlan::kWalksPerBlock);
    std::size_t segments = 0;
    for (std::vector<WalkSegment>& walk : walks)
    {
      walk = makeWalk(room, random);
      segments += walk.size();
    }
    block.reserve(segments + walks.size());
    for (std::uint32_t i = 0; i < walks.size(); ++i)
    {
      block.replaceTail(i, 0, static_cast<std::uint32_t>(walks[i].size()));
      for (std::uint32_t bounce = 0; bounce < walks[i].size(); ++bounce)
      {
        block.setSegment(i, bounce, walks[i][bounce]);
      }
    }
    size_ += segments;
    blocks_.push_back(std::move(block));
  }
}

std::size_t StoredSegments::bytes() const
{
  return std::accumulate(blocks_.begin(), blocks_.end(), std::size_t{ 0 },
    [](std::size_t sum, const WalkBlock& block) { return sum + block.bytes(); });
}
