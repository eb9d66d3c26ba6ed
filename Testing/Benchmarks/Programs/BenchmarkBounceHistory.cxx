// SPDX-License-Identifier: BSD-3-Clause
/**
 * What it takes to store segments, to find those near moved bodies by the scan, and to replace
 * tails; and the bytes that a segment takes. Beside the scan stands the least that any look at
 * every segment costs, to read memory once from end to end: as many bytes as the history holds, or
 * 24 a segment, its two ends as floats. Before any time counts, what was stored is read back, and
 * segments that a body may touch are looked for one by one. One thread.
 *
 * Arguments: [millions of segments = 8] [rounds = 7]
 */
#include "../../PhotonWalks/BounceFront.h"
#include "History/BounceScan.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Measuring/Rounds.h"
#include "Sampling/WalkPlan.h"
#include "Scene/RigidObject.h"

#include <algorithm>
#include <numeric>
#include <random>
#include <stdexcept>

using namespace irradiance;

namespace
{

const Box kRoom = { Vector3(-1.7, -1.1, 0), Vector3(1.7, 1.1, 2.4) };
constexpr std::uint32_t kWalks = WalkPlan::kWalksPerBlock;
constexpr std::uint32_t kEvery = 32; // of that many walks one changes in a frame
constexpr double kSurvival = 0.6;    // of a hit
constexpr const char* kTable = "History";

using Random = std::mt19937_64;

struct StraightSegment
{
  Vector3 origin, direction;
  double distance;
  std::uint32_t triangle;
};
using Walk = std::vector<StraightSegment>;

double uniform(Random& random)
{
  return std::uniform_real_distribution<double>()(random);
}

Vector3 pointOnWall(std::uint32_t wall, Random& random)
{
  Vector3 point = kRoom.lower;
  for (int axis = 0; axis < 3; ++axis)
  {
    point[axis] += uniform(random) * kRoom.extent()[axis];
  }
  const std::uint32_t axis = wall / 2;
  point[axis] = wall % 2 == 0 ? kRoom.lower[axis] : kRoom.upper[axis];
  return point;
}

/// From wall to wall; the directions are floats.
Walk makeWalk(Random& random)
{
  constexpr std::uint32_t kWalls = 6, kTriangles = 10000;
  auto wall = static_cast<std::uint32_t>(random() % kWalls);
  Vector3 from = pointOnWall(wall, random);
  Walk walk;
  do
  {
    wall = (wall + 1 + static_cast<std::uint32_t>(random() % (kWalls - 1))) % kWalls;
    const Vector3 to = pointOnWall(wall, random);
    const Vector3 direction = (to - from).normalized().cast<float>().cast<double>();
    walk.push_back(
      { from, direction, (to - from).norm(), static_cast<std::uint32_t>(random() % kTriangles) });
    from = to;
  } while (uniform(random) < kSurvival);
  return walk;
}

/// The segments of a block that were shot side by side: of one bounce, or first of the tails.
struct Front
{
  test::BounceFront segments;
  std::vector<std::uint32_t> before; ///< row in the front before
  std::vector<std::uint32_t> parents, slots;
  BounceColumns columns;

  void finish()
  {
    columns = segments.columns();
    parents.resize(segments.size(), BounceBlock::kNone);
    slots.resize(segments.size());
    columns.parents = parents.data();
  }
};

/// The walks of a block, and the fronts in which they are shot. Of each kEvery-th walk all but the
/// first segment is a tail that changes; those have fronts of their own.
struct Shot
{
  std::vector<Walk> walks;
  std::vector<Front> fronts, tails;

  explicit Shot(Random& random)
  {
    for (std::uint32_t i = 0; i < kWalks; ++i)
    {
      walks.push_back(makeWalk(random));
    }
    fronts = frontsFrom(0, 1);
    tails = frontsFrom(1, kEvery);
  }

  std::vector<Front> frontsFrom(std::uint32_t firstBounce, std::uint32_t every) const
  {
    std::vector<Front> made;
    std::vector<std::uint32_t> rowOf(kWalks, 0);
    for (std::uint32_t bounce = firstBounce;; ++bounce)
    {
      Front front;
      for (std::uint32_t i = 0; i < kWalks; i += every)
      {
        if (bounce < walks[i].size())
        {
          front.before.push_back(bounce == firstBounce ? i : rowOf[i]);
          rowOf[i] = static_cast<std::uint32_t>(front.segments.size());
          front.segments.add(segmentOf(i, walks[i][bounce]));
        }
      }
      if (front.segments.size() == 0)
      {
        break;
      }
      made.push_back(std::move(front));
    }
    for (Front& front : made)
    {
      front.finish();
    }
    return made;
  }

  static test::BounceSegment segmentOf(std::uint32_t walk, const StraightSegment& segment)
  {
    test::BounceSegment stored;
    stored.origin = segment.origin;
    stored.direction = segment.direction.cast<float>();
    stored.distance = segment.distance;
    stored.walk = walk;
    stored.triangle = segment.triangle;
    return stored;
  }
};

/// Few walks are repeated in all blocks, so that they are in the caches as what was just shot is.
struct History
{
  explicit History(std::size_t atLeast)
    : arena(BounceBlock::pageBytes(1))
  {
    constexpr std::size_t kDifferent = 2;
    Random random(1);
    std::size_t some = 0, someOfTails = 0;
    for (std::size_t i = 0; i < kDifferent; ++i)
    {
      const Shot& block = shot.emplace_back(random);
      for (const Front& front : block.fronts)
      {
        some += front.segments.size();
      }
      for (const Front& front : block.tails)
      {
        someOfTails += front.segments.size();
      }
    }
    const std::size_t times = atLeast / some + 1;
    blocks = times * kDifferent;
    segments = times * some;
    tailSegments = times * someOfTails;
  }

  const Shot& shotOf(std::size_t block) const { return shot[block % shot.size()]; }
  Shot& shotOf(std::size_t block) { return shot[block % shot.size()]; }

  void store()
  {
    stored.clear(); // its memory is used again
    stored.reserve(blocks);
    for (std::size_t b = 0; b < blocks; ++b)
    {
      Shot& block = shotOf(b);
      BounceBlock& own = stored.emplace_back(arena, 0, kWalks, 1, grid, Power{});
      const Front* before = nullptr;
      for (Front& front : block.fronts)
      {
        for (std::size_t i = 0; i < front.slots.size() && before != nullptr; ++i)
        {
          front.parents[i] = before->slots[front.before[i]];
        }
        own.append(front.columns, 0, front.slots.size(), front.slots.data());
        before = &front;
      }
    }
  }

  void replaceTails()
  {
    for (std::size_t b = 0; b < blocks; ++b)
    {
      BounceBlock& own = stored[b];
      for (std::uint32_t i = 0; i < kWalks; i += kEvery)
      {
        own.prefetch(i);
      }
      std::vector<std::uint32_t>& tails = scratch;
      tails.clear();
      for (std::uint32_t i = 0; i < kWalks; i += kEvery)
      {
        const std::uint32_t second = own.next(own.begin(i));
        if (second != BounceBlock::kNone)
        {
          tails.push_back(second);
          own.prefetch(second);
        }
      }
      for (const std::uint32_t second : tails)
      {
        own.removeFrom(second);
      }
      const Front* before = nullptr;
      for (Front& front : shotOf(b).tails)
      {
        for (std::size_t i = 0; i < front.slots.size(); ++i)
        {
          front.parents[i] = before ? before->slots[front.before[i]] : front.before[i];
        }
        own.append(front.columns, 0, front.slots.size(), front.slots.data());
        before = &front;
      }
    }
  }

  double bytes() const
  {
    double bytes = 0;
    for (const BounceBlock& block : stored)
    {
      bytes += static_cast<double>(block.bytes());
    }
    return bytes;
  }

  PointGrid grid = PointGrid(kRoom);
  BlockArena arena;
  std::vector<Shot> shot;
  std::vector<BounceBlock> stored;
  std::vector<std::uint32_t> scratch;
  std::size_t blocks = 0, segments = 0, tailSegments = 0;
};

/// What was stored must be there.
void checkStored(const History& history)
{
  for (std::size_t b = 0; b < history.blocks; ++b)
  {
    const BounceBlock& stored = history.stored[b];
    for (std::uint32_t i = 0; i < kWalks; ++i)
    {
      const Walk& walk = history.shotOf(b).walks[i];
      std::uint32_t slot = stored.begin(i);
      for (const StraightSegment& segment : walk)
      {
        if (slot == BounceBlock::kNone || stored.triangle(slot) != segment.triangle ||
          stored.walkOf(slot) != i)
        {
          throw std::runtime_error("A segment is not where it was stored");
        }
        slot = stored.next(slot);
      }
      if (slot != BounceBlock::kNone)
      {
        throw std::runtime_error("A walk does not end where it was stored");
      }
    }
  }
}

/// A cube of twelve triangles.
RigidObject makeCube()
{
  std::vector<Triangle> triangles;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double side : { -1.0, 1.0 })
    {
      const auto corner = [&](double u, double v) {
        Vector3 point;
        point[axis] = side;
        point[(axis + 1) % 3] = u;
        point[(axis + 2) % 3] = v;
        return point;
      };
      triangles.push_back({ corner(-1, -1), corner(1, -1), corner(1, 1) });
      triangles.push_back({ corner(-1, -1), corner(1, 1), corner(-1, 1) });
    }
  }
  return RigidObject(TriangleMesh(triangles));
}

struct Bodies
{
  std::vector<EllipsoidBound> bounds;
  std::vector<OwnBox> boxes;
};

Bodies makeBodies(const RigidObject& body, std::size_t count, double size)
{
  Random random(2);
  Bodies bodies;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    const AffineMap pose = { size * Matrix3::Identity(),
      kRoom.lower + 0.2 * kRoom.extent() + 0.6 * kRoom.extent().cwiseProduct(Vector3(x, y, z)) };
    bodies.bounds.emplace_back(body.ellipsoid(), body.mesh().bounds(), pose, 1e-6);
    bodies.boxes.push_back({ body.mesh().bounds(), pose, 1e-6 });
  }
  return bodies;
}

BounceScan makeScan(const History& history, const Bodies& bodies)
{
  BounceScan scan(history.grid);
  for (std::size_t i = 0; i < bodies.bounds.size(); ++i)
  {
    scan.addBody(bodies.bounds[i], &bodies.boxes[i]);
  }
  scan.addMoved(1);
  return scan;
}

std::size_t countFound(const std::vector<BounceBlock>& blocks, const BounceScan& scan)
{
  static std::vector<std::uint32_t> found;
  std::size_t count = 0;
  for (std::size_t i = 0; i < blocks.size(); ++i)
  {
    scan.find(blocks[i], blocks[std::min(i + 1, blocks.size() - 1)], found);
    count += found.size();
  }
  return count;
}

/// What comes into the box of a body must be found: sought at many places along each segment.
void checkScan(const History& history, const Bodies& bodies, const BounceScan& scan)
{
  const BounceBlock& block = history.stored.front();
  std::vector<std::uint32_t> found;
  scan.find(block, block, found);
  const auto isInside = [&](const Vector3& point) {
    return std::any_of(bodies.boxes.begin(), bodies.boxes.end(), [&](const OwnBox& own) {
      const Vector3 away = point - own.worldFromObject.translation;
      return away.cwiseAbs().maxCoeff() <= own.worldFromObject.linear(0, 0);
    });
  };
  for (std::uint32_t i = 0; i < kWalks; ++i)
  {
    std::uint32_t slot = block.begin(i);
    for (const StraightSegment& segment : history.shot.front().walks[i])
    {
      bool touches = false;
      for (double share = 0; share <= 1; share += 1.0 / 64)
      {
        touches =
          touches || isInside(segment.origin + share * segment.distance * segment.direction);
      }
      if (touches && !std::binary_search(found.begin(), found.end(), slot))
      {
        throw std::runtime_error("The scan misses a segment near a body");
      }
      slot = block.next(slot);
    }
  }
}

struct Case
{
  const char* name;
  std::size_t bodies;
  double size; ///< half the edge of a body, m
};

constexpr Case kCases[] = { { "scan, 1 body", 1, 0.3 }, { "scan, 4 bodies", 4, 0.15 },
  { "scan, 64 bodies", 64, 0.05 } };

/// Reads memory from end to end.
std::uint64_t read(const std::vector<std::uint64_t>& words)
{
  return std::accumulate(words.begin(), words.end(), std::uint64_t{ 0 });
}

void reportTime(
  const std::string& row, const char* quantity, double segments, const std::vector<double>& seconds)
{
  report(kTable, row, quantity, ratios(1, ratios(1e-9 * segments, seconds)));
}

}

void run(const Arguments& arguments)
{
  const double millions = arguments.number(0, 8.0);
  const int rounds = arguments.number(1, 7);
  History history(static_cast<std::size_t>(1e6 * millions));
  history.store();
  checkStored(history);
  const double bytes = history.bytes();
  history.replaceTails();
  checkStored(history);
  history.store();

  constexpr std::size_t kEnds = 6 * sizeof(float);
  const auto segments = static_cast<double>(history.segments);
  const std::vector<std::uint64_t> asHistory(
    static_cast<std::size_t>(bytes) / sizeof(std::uint64_t), 1),
    ends(kEnds * history.segments / sizeof(std::uint64_t), 1);
  volatile std::uint64_t used = 0; // so that nothing is optimized away
  std::vector<std::function<void()>> jobs = { [&] { used = used + read(asHistory); },
    [&] { used = used + read(ends); }, [&] { history.store(); } };
  const std::size_t first = jobs.size();
  const RigidObject body = makeCube();
  for (const Case& one : kCases)
  {
    const Bodies bodies = makeBodies(body, one.bodies, one.size);
    const BounceScan scan = makeScan(history, bodies);
    checkScan(history, bodies, scan);
    const std::size_t found = countFound(history.stored, scan);
    report(kTable, one.name, "share found", static_cast<double>(found) / segments);
    jobs.push_back([&, scan] { used = used + countFound(history.stored, scan); });
  }
  jobs.push_back([&] { history.replaceTails(); });
  const std::vector<std::vector<double>> seconds = timeInTurns(jobs, rounds);

  report("HistoryScan", kCases[0].name, "time / reading the history once",
    ratios(seconds[first], seconds[0]), { 0.5, 0.2 });
  for (std::size_t i = 0; i < std::size(kCases); ++i)
  {
    const std::vector<double>& scan = seconds[first + i];
    reportTime(kCases[i].name, "ns a segment", segments, scan);
    report(kTable, kCases[i].name, "time / reading the history once", ratios(scan, seconds[0]));
    report(kTable, kCases[i].name, "time / reading 24 bytes a segment", ratios(scan, seconds[1]));
  }
  reportTime("replace tails", "ns a segment", static_cast<double>(history.tailSegments),
    seconds[first + std::size(kCases)]);
  reportTime("store", "ns a segment", segments, seconds[2]);
  reportTime("read the history once", "ns a segment", segments, seconds[0]);
  report("HistoryBytes", "history", "bytes a segment", bytes / segments, { 38, 34 });
}
