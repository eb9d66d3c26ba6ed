/**
 * How fast the segments near moved bodies are found among many: SegmentScan beside the least that
 * any look at every segment costs, to read memory once from end to end. What is read are as many
 * bytes as the history holds, and, as a second peer, 24 bytes a segment: its two ends as floats.
 * The segments are random ones of a room, the bodies are as large as the teapot of
 * Examples/MovingTeapot or a tenth of that; before any time counts, the segments that touch a body
 * are looked for one by one, and all must be among those found. One thread.
 *
 * Arguments: [millions of segments = 16] [rounds = 7] (and with a quarter and a sixteenth of them)
 */
#include "MovingTeapotScene.h"

#include "Goals.h"
#include "History/SegmentScan.h"
#include "Program.h"
#include "ResultTable.h"
#include "Results.h"
#include "StoredSegments.h"
#include "Timing.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <random>
#include <stdexcept>

using namespace irradiance;

namespace
{

const Box kRoom = { Vector3(-1.7, -1.1, 0), Vector3(1.7, 1.1, 2.4) };

/// The teapot, at places at random in the room.
std::vector<EllipsoidBound> makeBodies(const RigidObject& teapot, std::size_t count, double scale)
{
  std::mt19937_64 random(2);
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
  SegmentScan scan(stored.frame(),
    std::max(stored.frame()(kRoom.lower).cwiseAbs().maxCoeff(),
      stored.frame()(kRoom.upper).cwiseAbs().maxCoeff()));
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
  const std::vector<WalkBlock>& blocks = stored.blocks();
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
    return Vector3(stored.frame().center + point / stored.frame().scale);
  };
  for (std::uint32_t i = 0; i + 1 < block.numberOfPoints(); ++i)
  {
    WalkBlock::Place unused;
    const bool mayTouch = block.segmentAt(i, unused) &&
      std::any_of(bodies.begin(), bodies.end(),
        [&](const EllipsoidBound& body) { return !body.rejects(place(i), place(i + 1)); });
    if (mayTouch && !std::binary_search(points.begin(), points.end(), i))
    {
      throw std::runtime_error("The scan misses a segment near a body");
    }
  }
}

/// Memory that is read from end to end.
class Bytes
{
public:
  explicit Bytes(std::size_t size)
    : words_(size / sizeof(std::uint64_t), 1)
  {
  }
  std::uint64_t read() const
  {
    return std::accumulate(words_.begin(), words_.end(), std::uint64_t{ 0 });
  }

private:
  std::vector<std::uint64_t> words_;
};

const char* const kOverHistory = "time / reading the history once";
const char* const kOverEnds = "time / reading 24 bytes a segment";

struct Case
{
  const char* name;
  std::size_t bodies;
  double scale;
};

constexpr Case kCases[] = { { "1 teapot", 1, 1 }, { "16 teapots", 16, 1 },
  { "1 teapot, tenth of the size", 1, 0.1 }, { "16 teapots, tenth of the size", 16, 0.1 } };

void timeScans(
  const RigidObject& teapot, double millions, bool isLargest, int rounds, Results& results)
{
  constexpr std::size_t kEnds = 6 * sizeof(float);
  const StoredSegments stored(kRoom, static_cast<std::size_t>(1e6 * millions));
  const Bytes history(stored.bytes()), ends(kEnds * stored.size());
  std::uint64_t used = 0; // so that nothing is optimized away
  std::vector<SegmentScan> scans;
  std::vector<std::function<void()>> jobs = { [&] { used += history.read(); },
    [&] { used += ends.read(); } };
  for (const Case& one : kCases)
  {
    const std::vector<EllipsoidBound> bodies = makeBodies(teapot, one.bodies, one.scale);
    scans.push_back(makeScan(stored, bodies));
    checkBlock(stored.blocks().front(), scans.back(), stored, bodies);
    jobs.push_back([&, i = scans.size() - 1] { used += countFound(stored, scans[i]); });
  }
  const std::vector<std::vector<double>> seconds = timeInTurns(jobs, rounds);
  const std::string size = shortNumber(millions) + " million segments, ";
  if (isLargest)
  {
    results.add("SegmentScan", size + kCases[0].name, kOverHistory, ratios(seconds[2], seconds[0]),
      goals::kSegmentScan);
  }
  for (std::size_t i = 0; i < scans.size(); ++i)
  {
    const std::string row = size + kCases[i].name;
    const std::vector<double>& own = seconds[2 + i];
    const auto found = static_cast<double>(countFound(stored, scans[i]));
    results.add("SegmentScanSizes", row, kOverHistory, ratios(own, seconds[0]));
    results.add("SegmentScanSizes", row, kOverEnds, ratios(own, seconds[1]));
    results.add(
      "SegmentScanSizes", row, "share found", { found / static_cast<double>(stored.size()) });
  }
  std::printf("%s%.1f bytes a segment, read at %.1f GB/s, scanned in %.2f ns a segment (%llu)\n",
    size.c_str(), static_cast<double>(stored.bytes()) / static_cast<double>(stored.size()),
    1e-9 * static_cast<double>(stored.bytes()) / spreadOf(seconds[0]).median,
    1e9 * spreadOf(seconds[2]).median / static_cast<double>(stored.size()),
    static_cast<unsigned long long>(used % 10));
  std::fflush(stdout);
}

void run(int argc, char* argv[])
{
  const double millions = argc > 1 ? std::strtod(argv[1], nullptr) : 16;
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 7;
  Results results("BenchmarkSegmentScan");
  const SceneObjects objects = MovingTeapotScene("").objectsAt(0);
  for (const double part : { 16.0, 4.0, 1.0 })
  {
    timeScans(*objects.dynamicObjects[0].body, millions / part, part == 1, rounds, results);
  }
  results.finish();
}

}

int main(int argc, char* argv[])
{
  return runProgram(run, argc, argv);
}
