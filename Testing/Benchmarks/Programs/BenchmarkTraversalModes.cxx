/**
 * Section 2.5 of the paper: the static and the dynamic triangles in one tree, in two trees searched
 * one after the other, and in two trees searched side by side. The dynamic triangles are loose, each
 * moves on its own: "we wanted to have a high number of dynamic objects, instead of a few composite
 * ones". The hits of the three modes must be the same bits; then the modes are timed in turns on one
 * thread, and the steps of their searches counted. What one tree costs besides, to be rebuilt whole in
 * every frame, is not in these times.
 *
 * Arguments: [rays = 300000] [rounds = 7]
 */
#include "Kernels/CastCounts.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Measuring/Rounds.h"
#include "Rivals/OurCaster.h"
#include "Scenes/RaySet.h"

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

std::vector<Caster> makeCasters(const SceneObjects& objects)
{
  std::vector<Caster> casters;
  for (const Mode& mode : kModes)
  {
    casters.push_back(makeOurCaster(makeScene(objects, mode.mode), simdChoices().front().level));
  }
  return casters;
}

/// What a ray costs in steps, which no other program on the machine can disturb.
CastCounts countSteps(const std::function<void()>& cast)
{
  CastCounts counts;
  castCounts() = &counts;
  cast();
  castCounts() = nullptr;
  return counts;
}

/// The casts of each mode, in the order of kModes, into `hits`. The first is the measure.
std::vector<std::function<void()>> checkedCasts(const std::vector<Caster>& casters,
  const std::vector<Ray>& rays, std::vector<std::vector<Hit>>& hits)
{
  std::vector<std::function<void()>> casts;
  for (std::size_t i = 0; i < casters.size(); ++i)
  {
    casts.push_back([cast = casters[i](rays), &found = hits[i]] { cast(found); });
    casts.back()();
    if (hits[i] != hits[0])
    {
      throw std::runtime_error(
        std::string(kModes[i].name) + " finds other hits than " + kModes[0].name);
    }
  }
  return casts;
}

void timeScene(const BenchmarkScene& scene, std::uint32_t count, int rounds)
{
  const std::vector<Caster> casters = makeCasters(scene.objects);
  std::vector<std::vector<double>> overOneTree, overSequential; // [set][round]
  for (const RaySet& set : makeRaySets(scene, count))
  {
    std::vector<std::vector<Hit>> hits(casters.size(), std::vector<Hit>(count));
    const std::vector<std::function<void()>> casts = checkedCasts(casters, set.rays, hits);
    const std::vector<std::vector<double>> seconds = timeInTurns(casts, rounds);
    const std::string column = scene.name + ", " + set.letter;
    for (std::size_t i = 0; i < casts.size(); ++i)
    {
      const std::string name = kModes[i].name;
      report("TraversalModesSets", name, column, ratios(seconds[i], seconds[0]));
      report("TraversalModesRates", name, column, ratios(1e-6 * count, seconds[i]));
      const auto reportSteps = [&](const char* what, std::uint64_t steps) {
        report("TraversalModesCounts", name + ", " + what, column,
          static_cast<double>(steps) / static_cast<double>(count));
      };
      const CastCounts counts = countSteps(casts[i]);
      reportSteps("treelets entered", counts.treelets);
      reportSteps("blocks tested", counts.blocks);
      reportSteps("triangles tested in double", counts.triangles);
    }
    overOneTree.push_back(ratios(seconds[0], seconds[2]));
    overSequential.push_back(ratios(seconds[1], seconds[2]));
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
