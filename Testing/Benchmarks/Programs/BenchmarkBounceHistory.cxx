// SPDX-License-Identifier: BSD-3-Clause
/**
 * The history by bounces beside that by walks: what it takes to store segments, to find those near
 * moved bodies, and to replace tails; and the bytes that a segment takes. Before any time counts, what
 * was stored is read back, and segments that a body may touch are looked for one by one. One thread.
 *
 * Arguments: [millions of segments = 2] [rounds = 7]
 */
#include "../../PhotonWalks/BounceFront.h"
#include "../../PhotonWalks/ShotWalk.h"
#include "History/SegmentIndex.h"
#include "History/SegmentScan.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Measuring/Rounds.h"
#include "Scene/RigidObject.h"

#include <algorithm>
#include <random>
#include <stdexcept>

using namespace irradiance;

namespace
{

const Box kRoom = { Vector3(-1.7, -1.1, 0), Vector3(1.7, 1.1, 2.4) };
constexpr std::uint32_t kWalks = WalkPlan::kWalksPerBlock;
constexpr std::uint32_t kEvery = 32; // of that many walks one changes in a frame
constexpr double kSurvival = 0.6;    // of a hit

using Random = std::mt19937_64;
using Walk = std::vector<test::WalkSegment>;

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
    test::WalkSegment& segment = walk.emplace_back();
    segment.ray = { from, (to - from).normalized().cast<float>().cast<double>(), {} };
    segment.hit = { (to - from).norm(), { 0, static_cast<std::uint32_t>(random() % kTriangles) },
      {} };
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

/// The walks of a block, and the fronts in which they are shot. Of each kEvery-th walk all but the first
/// segment is a tail that changes; those have fronts of their own.
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

  static test::BounceSegment segmentOf(std::uint32_t walk, const test::WalkSegment& segment)
  {
    test::BounceSegment stored;
    stored.origin = segment.ray.origin;
    stored.direction = segment.ray.direction.cast<float>();
    stored.distance = segment.hit.distance;
    stored.walk = walk;
    stored.triangle = segment.hit.id.triangle;
    return stored;
  }
};

/// Both histories of the same walks. Few walks are repeated in all blocks, so that they are in the
/// caches as what was just shot is.
struct Histories
{
  explicit Histories(std::size_t atLeast)
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

  void storeByBounces()
  {
    byBounces.clear(); // its memory is used again
    byBounces.reserve(blocks);
    for (std::size_t b = 0; b < blocks; ++b)
    {
      Shot& block = shotOf(b);
      BounceBlock& stored = byBounces.emplace_back(arena, 0, kWalks, 1, grid, Power{});
      const Front* before = nullptr;
      for (Front& front : block.fronts)
      {
        for (std::size_t i = 0; i < front.slots.size() && before != nullptr; ++i)
        {
          front.parents[i] = before->slots[front.before[i]];
        }
        stored.append(front.columns, 0, front.slots.size(), front.slots.data());
        before = &front;
      }
    }
  }

  void storeByWalks()
  {
    byWalks.clear();
    byWalks.reserve(blocks);
    std::vector<std::uint32_t> sizes(kWalks);
    for (std::size_t b = 0; b < blocks; ++b)
    {
      const Shot& block = shotOf(b);
      WalkBlock& stored = byWalks.emplace_back(0, kWalks, 1, frame, Power{});
      std::transform(block.walks.begin(), block.walks.end(), sizes.begin(),
        [](const Walk& walk) { return static_cast<std::uint32_t>(walk.size()); });
      stored.makeRoom(sizes);
      for (std::uint32_t i = 0; i < kWalks; ++i)
      {
        test::replaceTail(stored, { i, 0 }, block.walks[i], frame);
      }
    }
  }

  void replaceByBounces()
  {
    for (std::size_t b = 0; b < blocks; ++b)
    {
      BounceBlock& stored = byBounces[b];
      for (std::uint32_t i = 0; i < kWalks; i += kEvery)
      {
        stored.prefetch(i);
      }
      std::vector<std::uint32_t>& tails = scratch;
      tails.clear();
      for (std::uint32_t i = 0; i < kWalks; i += kEvery)
      {
        const std::uint32_t second = stored.next(stored.begin(i));
        if (second != BounceBlock::kNone)
        {
          tails.push_back(second);
          stored.prefetch(second);
        }
      }
      for (const std::uint32_t second : tails)
      {
        stored.removeFrom(second);
      }
      const Front* before = nullptr;
      for (Front& front : shotOf(b).tails)
      {
        for (std::size_t i = 0; i < front.slots.size(); ++i)
        {
          front.parents[i] = before ? before->slots[front.before[i]] : front.before[i];
        }
        stored.append(front.columns, 0, front.slots.size(), front.slots.data());
        before = &front;
      }
    }
  }

  void replaceByWalks()
  {
    Walk tail;
    for (std::size_t b = 0; b < blocks; ++b)
    {
      for (std::uint32_t i = 0; i < kWalks; i += kEvery)
      {
        const Walk& walk = shotOf(b).walks[i];
        if (walk.size() > 1)
        {
          tail.assign(walk.begin() + 1, walk.end());
          test::replaceTail(byWalks[b], { i, 1 }, tail, frame);
        }
      }
    }
  }

  template <class Block>
  static double bytesOf(const std::vector<Block>& blocks)
  {
    double bytes = 0;
    for (const Block& block : blocks)
    {
      bytes += static_cast<double>(block.bytes());
    }
    return bytes;
  }

  PointGrid grid = PointGrid(kRoom);
  UnitFrame frame = UnitFrame(kRoom);
  BlockArena arena;
  std::vector<Shot> shot;
  std::vector<BounceBlock> byBounces;
  std::vector<WalkBlock> byWalks;
  std::vector<std::uint32_t> scratch;
  std::size_t blocks = 0, segments = 0, tailSegments = 0;
};

/// What was stored must be there.
void checkStored(const Histories& histories)
{
  for (std::size_t b = 0; b < histories.blocks; ++b)
  {
    const BounceBlock& stored = histories.byBounces[b];
    for (std::uint32_t i = 0; i < kWalks; ++i)
    {
      const Walk& walk = histories.shotOf(b).walks[i];
      std::uint32_t slot = stored.begin(i);
      for (const test::WalkSegment& segment : walk)
      {
        if (slot == BounceBlock::kNone || stored.triangle(slot) != segment.hit.id.triangle ||
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

BounceScan scanByBounces(const Histories& histories, const Bodies& bodies)
{
  BounceScan scan(histories.grid);
  for (std::size_t i = 0; i < bodies.bounds.size(); ++i)
  {
    scan.addBody(bodies.bounds[i], &bodies.boxes[i]);
  }
  scan.addMoved(1);
  return scan;
}

SegmentScan scanByWalks(const Histories& histories, const Bodies& bodies)
{
  SegmentScan scan(histories.frame, 1);
  for (const EllipsoidBound& bound : bodies.bounds)
  {
    scan.addBody(bound);
  }
  scan.addMoved(1);
  return scan;
}

template <class Block, class Scan>
std::size_t countFound(const std::vector<Block>& blocks, const Scan& scan)
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

/// Each of some blocks; what follows is theirs.
struct Indexes
{
  explicit Indexes(const Histories& histories)
  {
    for (std::size_t first = 0; first < histories.blocks; first += SegmentIndex::kBlocks)
    {
      SegmentIndex::Blocks& some = blocks.emplace_back();
      for (std::size_t b = first; b < std::min(first + SegmentIndex::kBlocks, histories.blocks);
           ++b)
      {
        some.push_back(&histories.byBounces[b]);
      }
      all.emplace_back(some);
    }
  }

  std::size_t countFound(const BounceScan& scan) const
  {
    static std::vector<std::vector<std::uint32_t>> found;
    std::size_t count = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      all[i].find(blocks[i], scan, found);
      for (std::size_t b = 0; b < blocks[i].size(); ++b)
      {
        count += found[b].size();
      }
    }
    return count;
  }

  double bytes() const
  {
    double bytes = 0;
    for (const SegmentIndex& index : all)
    {
      bytes += static_cast<double>(index.bytes());
    }
    return bytes;
  }

  std::vector<SegmentIndex::Blocks> blocks;
  std::vector<SegmentIndex> all;
};

/// What comes into the box of a body must be found: sought at many places along each segment.
void checkScan(const Histories& histories, const Bodies& bodies, const BounceScan& scan)
{
  const BounceBlock& block = histories.byBounces.front();
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
    for (const test::WalkSegment& segment : histories.shot.front().walks[i])
    {
      bool touches = false;
      for (double share = 0; share <= 1; share += 1.0 / 64)
      {
        touches = touches ||
          isInside(segment.ray.origin + share * segment.hit.distance * segment.ray.direction);
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

/// Seconds as ns a segment, beside those of today's history.
void reportPair(const std::string& row, double segments, const std::vector<double>& own,
  const std::vector<double>& other)
{
  const auto nanoseconds = [&](std::vector<double> seconds) {
    for (double& value : seconds)
    {
      value *= 1e9 / segments;
    }
    return seconds;
  };
  report("BounceHistory", row, "ns a segment", nanoseconds(own));
  report("BounceHistory", row, "ns a segment, by walks", nanoseconds(other));
  report("BounceHistory", row, "time / by walks", ratios(own, other));
}

}

void run(const Arguments& arguments)
{
  const double millions = arguments.number(0, 2.0);
  const int rounds = arguments.number(1, 7);
  Histories histories(static_cast<std::size_t>(1e6 * millions));
  histories.storeByBounces();
  histories.storeByWalks();
  checkStored(histories);
  const double bytes = Histories::bytesOf(histories.byBounces);
  const double bytesByWalks = Histories::bytesOf(histories.byWalks);
  histories.replaceByBounces();
  checkStored(histories);

  const RigidObject body = makeCube();
  volatile std::size_t used = 0; // so that nothing is optimized away
  std::vector<std::function<void()>> jobs;
  const Indexes indexes(histories);
  for (const Case& one : kCases)
  {
    const Bodies bodies = makeBodies(body, one.bodies, one.size);
    const BounceScan scan = scanByBounces(histories, bodies);
    const SegmentScan scanOfWalks = scanByWalks(histories, bodies);
    checkScan(histories, bodies, scan);
    jobs.push_back([&, scan] { used = used + countFound(histories.byBounces, scan); });
    jobs.push_back([&, scanOfWalks] { used = used + countFound(histories.byWalks, scanOfWalks); });
    jobs.push_back([&, scan] { used = used + indexes.countFound(scan); });
    if (indexes.countFound(scan) != countFound(histories.byBounces, scan))
    {
      throw std::runtime_error("The index does not find what the scan finds");
    }
    const auto all = static_cast<double>(histories.segments);
    report("BounceHistory", one.name, "share found",
      static_cast<double>(countFound(histories.byBounces, scan)) / all);
    report("BounceHistory", one.name, "share found, by walks",
      static_cast<double>(countFound(histories.byWalks, scanOfWalks)) / all);
  }
  jobs.push_back([&] { histories.replaceByBounces(); });
  jobs.push_back([&] { histories.replaceByWalks(); });
  jobs.push_back([&] { used = used + Indexes(histories).all.size(); });
  jobs.push_back([&] { histories.storeByBounces(); });
  jobs.push_back([&] { histories.storeByWalks(); });
  const std::vector<std::vector<double>> seconds = timeInTurns(jobs, rounds);

  const auto segments = static_cast<double>(histories.segments);
  const std::size_t cases = std::size(kCases);
  for (std::size_t i = 0; i < cases; ++i)
  {
    reportPair(kCases[i].name, segments, seconds[3 * i], seconds[3 * i + 1]);
    report("BounceHistory", kCases[i].name, "ns a segment, by index",
      ratios(1, ratios(1e-9 * segments, seconds[3 * i + 2])));
  }
  const auto* const rest = seconds.data() + 3 * cases;
  reportPair("replace tails", static_cast<double>(histories.tailSegments), rest[0], rest[1]);
  report("BounceHistory", "index", "ns a segment", ratios(1, ratios(1e-9 * segments, rest[2])));
  report("BounceHistory", "index", "bytes a segment", indexes.bytes() / segments);
  reportPair("store", segments, rest[3], rest[4]);
  report("BounceHistory", "memory", "bytes a segment", bytes / segments, { 38, 34 });
  report("BounceHistory", "memory", "bytes a segment, by walks", bytesByWalks / segments);
}
