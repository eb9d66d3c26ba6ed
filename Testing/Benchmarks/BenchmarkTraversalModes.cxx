/**
 * Section 2.5 of the paper: the static and the dynamic triangles in one tree, in two trees searched
 * one after the other, and in two trees searched side by side. The dynamic triangles are loose, each
 * moves on its own: "we wanted to have a high number of dynamic objects, instead of a few composite
 * ones". The hits of the three modes must be the same bits; then the modes are timed in turns on one
 * thread, and the steps of their searches counted. What one tree costs besides, to be rebuilt whole in every frame, is not in these times.
 *
 * Arguments: [rays = 300000] [rounds = 7]
 */
#include "BenchmarkScene.h"
#include "Goals.h"
#include "Kernels/QueryCounts.h"
#include "OurCaster.h"
#include "Program.h"
#include "RaySet.h"
#include "Results.h"
#include "Timing.h"

#include <cstdio>
#include <cstdlib>
#include <stdexcept>

using namespace irradiance;

namespace
{

struct Mode
{
  TraversalMode mode;
  const char* name;
};

constexpr Mode kModes[] = { { TraversalMode::OneTree, "one tree" },
  { TraversalMode::Sequential, "sequential" }, { TraversalMode::Parallel, "parallel" } };

std::vector<std::unique_ptr<OurCaster>> makeCasters(const SceneObjects& objects)
{
  std::vector<std::unique_ptr<OurCaster>> casters;
  for (const Mode& mode : kModes)
  {
    casters.push_back(
      std::make_unique<OurCaster>(mode.name, makeScene(objects, mode.mode), simdChoices().front()));
  }
  return casters;
}

/// Of each mode, in the order of kModes.
std::vector<std::vector<double>> timeModes(
  const std::vector<std::unique_ptr<OurCaster>>& casters, const std::vector<Ray>& rays, int rounds)
{
  std::vector<std::vector<Hit>> hits(casters.size(), std::vector<Hit>(rays.size()));
  std::vector<std::function<void()>> jobs;
  for (std::size_t i = 0; i < casters.size(); ++i)
  {
    casters[i]->setRays(rays);
    jobs.push_back([&caster = *casters[i], &found = hits[i]] { caster.cast(found); });
    jobs.back()();
    if (hits[i] != hits[0])
    {
      throw std::runtime_error(casters[i]->name() + " finds other hits than " + casters[0]->name());
    }
  }
  return timeInTurns(jobs, rounds);
}

/// What a ray costs in steps, which no other program on the machine can disturb.
void countSteps(OurCaster& caster, std::size_t rays, const std::string& column, Results& results)
{
  QueryCounts counts;
  queryCounts() = &counts;
  std::vector<Hit> hits(rays);
  caster.cast(hits);
  queryCounts() = nullptr;
  const auto add = [&](const char* what, std::uint64_t count) {
    results.add("TraversalModesCounts", caster.name() + ", " + what, column,
      { static_cast<double>(count) / static_cast<double>(rays) });
  };
  add("treelets entered", counts.treelets);
  add("blocks tested", counts.blocks);
  add("triangles tested in double", counts.triangles);
}

/// Speed of searching side by side, as the geometric mean over the sets of rays.
void addGoals(const std::string& scene, const std::vector<std::vector<double>>& overOneTree,
  const std::vector<std::vector<double>>& overSequential, Results& results)
{
  results.add("TraversalModes", "parallel: " + scene, "speed / one tree",
    geometricMeans(overOneTree), goals::kParallelOverOneTree);
  results.add("TraversalModes", "parallel: " + scene, "speed / sequential",
    geometricMeans(overSequential), goals::kParallelOverSequential);
}

void timeScene(const BenchmarkScene& scene, std::uint32_t count, int rounds, Results& results)
{
  const std::vector<std::unique_ptr<OurCaster>> casters = makeCasters(scene.objects);
  std::vector<std::vector<double>> overOneTree, overSequential; // [set][round]
  for (const RaySet set : { RaySet::Surfaces, RaySet::Light })
  {
    const std::vector<std::vector<double>> seconds =
      timeModes(casters, makeRays(scene, set, count), rounds);
    const std::string column = scene.name + ", " + letterOf(set);
    for (std::size_t i = 0; i < casters.size(); ++i)
    {
      const std::string& name = casters[i]->name();
      results.add("TraversalModesSets", name, column, ratios(seconds[i], seconds[0]));
      const std::vector<double> millions(seconds[i].size(), 1e-6 * count);
      results.add("TraversalModesRates", name, column, ratios(millions, seconds[i]));
      countSteps(*casters[i], count, column, results);
    }
    overOneTree.push_back(ratios(seconds[0], seconds[2]));
    overSequential.push_back(ratios(seconds[1], seconds[2]));
  }
  addGoals(scene.name, overOneTree, overSequential, results);
}

void run(int argc, char* argv[])
{
  const auto count =
    static_cast<std::uint32_t>(argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 300000);
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 7;
  Results results("BenchmarkTraversalModes");
  timeScene(makeTeapotsScene(), count, rounds, results);
  timeScene(makeRandomScene(true), count, rounds, results);
  results.finish();
}

}

int main(int argc, char* argv[])
{
  return runProgram(run, argc, argv);
}
