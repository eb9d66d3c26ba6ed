// SPDX-License-Identifier: BSD-3-Clause
/**
 * How fast the segments near moved bodies are found among many: SegmentScan beside the least that any
 * look at every segment costs, to read memory once from end to end. What is read are as many bytes as
 * the history holds, and, as a second peer, 24 bytes a segment: its two ends as floats. Before any time
 * counts, the segments that touch a body are looked for one by one. One thread.
 *
 * Arguments: [millions of segments = 16] [rounds = 7] (and with a quarter and a sixteenth of them)
 */
#include "../../PhotonWalks/ShotWalk.h"
#include "History/SegmentScan.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Measuring/Rounds.h"
#include "Scenes/MovingTeapotScene.h"

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <random>
#include <stdexcept>

using namespace irradiance;

namespace
{

const Box kRoom = { Vector3(-1.7, -1.1, 0), Vector3(1.7, 1.1, 2.4) };

using Random = std::mt19937_64;

Vector3 pointOnWall(std::uint32_t wall, Random& random)
{
  std::uniform_real_distribution<double> unit;
  Vector3 point = kRoom.lower;
  for (int axis = 0; axis < 3; ++axis)
  {
    point[axis] += unit(random) * kRoom.extent()[axis];
  }
  const std::uint32_t axis = wall / 2;
  point[axis] = wall % 2 == 0 ? kRoom.lower[axis] : kRoom.upper[axis];
  return point;
}

/// From wall to wall, never along one.
std::vector<test::WalkSegment> makeWalk(Random& random)
{
  constexpr std::uint32_t kWalls = 6, kLongest = 7, kTriangles = 10000;
  const auto below = [&](std::uint32_t limit) { return std::uint32_t(random() % limit); };
  std::uint32_t wall = below(kWalls);
  Vector3 from = pointOnWall(wall, random);
  std::vector<test::WalkSegment> walk(1 + below(kLongest));
  for (test::WalkSegment& segment : walk)
  {
    wall = (wall + 1 + below(kWalls - 1)) % kWalls;
    const Vector3 to = pointOnWall(wall, random);
    segment.ray = { from, (to - from).normalized(), {} };
    segment.hit = { (to - from).norm(), { 0, below(kTriangles) }, {} };
    from = to;
  }
  return walk;
}

/// The history of many walks at random, without the cost of shooting them: chains of points on the
/// walls of the room, of 1 to 7 segments each.
struct StoredSegments
{
  explicit StoredSegments(std::size_t atLeast)
  {
    Random random(1);
    while (size < atLeast)
    {
      std::vector<std::vector<test::WalkSegment>> walks;
      std::size_t segments = 0;
      while (walks.size() < WalkPlan::kWalksPerBlock)
      {
        walks.push_back(makeWalk(random));
        segments += walks.back().size();
      }
      WalkBlock& block = blocks.emplace_back(0, WalkPlan::kWalksPerBlock, 1, frame, Power{});
      std::vector<std::uint32_t> sizes;
      for (const auto& walk : walks)
      {
        sizes.push_back(static_cast<std::uint32_t>(walk.size()));
      }
      block.makeRoom(sizes);
      for (std::uint32_t i = 0; i < walks.size(); ++i)
      {
        test::replaceTail(block, { i, 0 }, walks[i], frame);
      }
      size += segments;
      bytes += block.bytes();
    }
  }

  UnitFrame frame = UnitFrame(kRoom); ///< of the points
  std::vector<WalkBlock> blocks;
  std::size_t size = 0;
  std::size_t bytes = 0; ///< memory that the blocks hold
};

/// The teapot, at places at random in the room.
std::vector<EllipsoidBound> makeBodies(const RigidObject& teapot, std::size_t count, double scale)
{
  Random random(2);
  std::uniform_real_distribution<double> unit;
  std::vector<EllipsoidBound> bodies;
  for (std::size_t i = 0; i < count; ++i)
  {
    const Vector3 place(unit(random), unit(random), unit(random));
    const AffineMap pose = { scale * Matrix3::Identity(),
      kRoom.lower + 0.2 * kRoom.extent() + 0.6 * kRoom.extent().cwiseProduct(place) };
    bodies.emplace_back(teapot.ellipsoid(), teapot.mesh().bounds(), pose, 1e-6);
  }
  return bodies;
}

SegmentScan makeScan(const StoredSegments& stored, const std::vector<EllipsoidBound>& bodies)
{
  SegmentScan scan(stored.frame,
    std::max(stored.frame(kRoom.lower).cwiseAbs().maxCoeff(),
      stored.frame(kRoom.upper).cwiseAbs().maxCoeff()));
  for (const EllipsoidBound& body : bodies)
  {
    scan.addBody(body);
  }
  scan.addMoved(1);
  return scan;
}

std::size_t countFound(const StoredSegments& stored, const SegmentScan& scan)
{
  static std::vector<std::uint32_t> points;
  std::size_t count = 0;
  const std::vector<WalkBlock>& blocks = stored.blocks;
  for (std::size_t i = 0; i < blocks.size(); ++i)
  {
    scan.find(blocks[i], blocks[std::min(i + 1, blocks.size() - 1)], points);
    count += points.size();
  }
  return count;
}

/// What a body may touch must be found: the proof of the bound, segment by segment, is the measure.
void checkBlock(const WalkBlock& block, const SegmentScan& scan, const StoredSegments& stored,
  const std::vector<EllipsoidBound>& bodies)
{
  std::vector<std::uint32_t> points;
  scan.find(block, block, points);
  const auto place = [&](std::size_t i) {
    const Vector3 point(block.x()[i], block.y()[i], block.z()[i]);
    return Vector3(stored.frame.center + point / stored.frame.scale);
  };
  for (std::uint32_t i = 0; i + 1 < block.numberOfPoints(); ++i)
  {
    const bool mayTouch = block.segmentAt(i) &&
      std::any_of(bodies.begin(), bodies.end(),
        [&](const EllipsoidBound& body) { return !body.rejects(place(i), place(i + 1)); });
    if (mayTouch && !std::binary_search(points.begin(), points.end(), i))
    {
      throw std::runtime_error("The scan misses a segment near a body");
    }
  }
}

/// Reads memory from end to end.
std::uint64_t read(const std::vector<std::uint64_t>& words)
{
  return std::accumulate(words.begin(), words.end(), std::uint64_t{ 0 });
}

struct Case
{
  const char* name;
  std::size_t bodies;
  double scale;
};

constexpr Case kCases[] = { { "1 teapot", 1, 1 }, { "16 teapots", 16, 1 },
  { "1 teapot, tenth of the size", 1, 0.1 }, { "16 teapots, tenth of the size", 16, 0.1 } };

void timeScans(const RigidObject& teapot, double millions, bool isLargest, int rounds)
{
  constexpr std::size_t kEnds = 6 * sizeof(float);
  const char* const overHistory = "time / reading the history once";
  const StoredSegments stored(static_cast<std::size_t>(1e6 * millions));
  const auto segments = static_cast<double>(stored.size);
  const std::vector<std::uint64_t> history(stored.bytes / sizeof(std::uint64_t), 1),
    ends(kEnds * stored.size / sizeof(std::uint64_t), 1);
  volatile std::uint64_t used = 0; // so that nothing is optimized away
  std::vector<std::function<void()>> jobs = { [&] { used = used + read(history); },
    [&] { used = used + read(ends); } };
  std::vector<double> shares;
  for (const Case& one : kCases)
  {
    const std::vector<EllipsoidBound> bodies = makeBodies(teapot, one.bodies, one.scale);
    const SegmentScan scan = makeScan(stored, bodies);
    checkBlock(stored.blocks.front(), scan, stored, bodies);
    shares.push_back(static_cast<double>(countFound(stored, scan)) / segments);
    jobs.push_back([&, scan] { used = used + countFound(stored, scan); });
  }
  const std::vector<std::vector<double>> seconds = timeInTurns(jobs, rounds);
  char size[32];
  std::snprintf(size, sizeof size, "%.3g million segments, ", millions);
  for (std::size_t i = 0; i < shares.size(); ++i)
  {
    const std::string row = std::string(size) + kCases[i].name;
    const std::vector<double>& own = seconds[2 + i];
    if (isLargest && i == 0)
    {
      report("SegmentScan", row, overHistory, ratios(own, seconds[0]), { 0.5, 0.2 });
    }
    report("SegmentScanSizes", row, overHistory, ratios(own, seconds[0]));
    report("SegmentScanSizes", row, "time / reading 24 bytes a segment", ratios(own, seconds[1]));
    report("SegmentScanSizes", row, "share found", shares[i]);
  }
  const auto bytes = static_cast<double>(stored.bytes);
  const std::string all = std::string(size) + kCases[0].name;
  report("SegmentScanUnits", all, "bytes a segment", bytes / segments);
  report("SegmentScanUnits", all, "GB/s of reading", ratios(1e-9 * bytes, seconds[0]));
  report("SegmentScanUnits", all, "million segments a second", ratios(1e-6 * segments, seconds[2]));
}

}

void run(const Arguments& arguments)
{
  const double millions = arguments.number(0, 16.0);
  const int rounds = arguments.number(1, 7);
  const SceneObjects objects = makeMovingTeapot("").at(0);
  for (const double part : { 16.0, 4.0, 1.0 })
  {
    timeScans(*objects.dynamicObjects[0].body, millions / part, part == 1, rounds);
  }
}
