// SPDX-License-Identifier: BSD-3-Clause
/**
 * Section 2.5 of the paper: the static and the dynamic triangles in one tree, in two trees searched
 * one after the other, and in two trees searched side by side. Each dynamic triangle moves on its
 * own. The hits of the three modes must be the same bits; then the modes are timed in turns on one
 * thread, and the steps of their searches counted. To rebuild the one tree in every frame is not in
 * these times.
 *
 * Arguments: [rays = 300000] [rounds = 7]
 */
#include "Kernels/QueryCounts.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Measuring/Rounds.h"
#include "Rivals/CastContest.h"
#include "Rivals/OurCaster.h"
#include "Scenes/RaySet.h"

using namespace irradiance;

namespace
{

std::vector<Contender> makeContenders(const SceneObjects& objects)
{
  const auto contender = [&](const char* name, TraversalMode mode) -> Contender {
    return { name, makeOurCaster(makeScene(objects, mode), SimdLevel::Avx512), 0 };
  };
  return { contender("one tree", TraversalMode::OneTree),
    contender("sequential", TraversalMode::Sequential),
    contender("parallel", TraversalMode::Parallel) };
}

/// What a ray costs in steps, which no other program on the machine can disturb.
void reportSteps(
  const Contender& contender, const std::vector<Ray>& rays, const std::string& column)
{
  QueryCounts counts;
  std::vector<Hit> hits(rays.size());
  queryCounts() = &counts;
  contender.caster(rays)(hits);
  queryCounts() = nullptr;
  const auto reportEach = [&](const char* what, std::uint64_t steps) {
    report("TraversalModesCounts", contender.name + ", " + what, column,
      static_cast<double>(steps) / static_cast<double>(rays.size()));
  };
  reportEach("treelets entered", counts.treelets);
  reportEach("blocks tested", counts.blocks);
}

void timeScene(const BenchmarkScene& scene, std::uint32_t count, int rounds)
{
  const std::vector<Contender> contenders = makeContenders(scene.objects);
  std::vector<std::vector<double>> overOneTree, overSequential; // [set][round]
  for (const RaySet& set : makeRaySets(scene, count))
  {
    const std::string column = scene.name + ", " + set.letter;
    const std::vector<Performance> performances = compete(contenders, set.rays, rounds);
    const auto seconds = [&](std::size_t i) { return performances[i].seconds; };
    for (std::size_t i = 0; i < contenders.size(); ++i)
    {
      report("TraversalModesSets", contenders[i].name, column, ratios(seconds(i), seconds(0)));
      report("TraversalModesRates", contenders[i].name, column, ratios(1e-6, seconds(i)));
      reportSteps(contenders[i], set.rays, column);
    }
    overOneTree.push_back(ratios(seconds(0), seconds(2)));
    overSequential.push_back(ratios(seconds(1), seconds(2)));
  }
  report("TraversalModes", "parallel: " + scene.name, "speed / one tree",
    geometricMeans(overOneTree), { 0.9, 1.0 });
  report("TraversalModes", "parallel: " + scene.name, "speed / sequential",
    geometricMeans(overSequential), { 1.0, 1.1 });
}

}

void run(const Arguments& arguments)
{
  const auto count = arguments.number(0, 300000u);
  const int rounds = arguments.number(1, 7);
  timeScene(makeTeapotsScene(), count, rounds);
  timeScene(makeRandomScene(true), count, rounds);
}
