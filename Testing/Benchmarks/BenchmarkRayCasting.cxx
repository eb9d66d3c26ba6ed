/**
 * Closest hits per second on one thread: our trees, flat (all triangles static) and two-level (a
 * static and a dynamic tree), beside Embree, CGAL and VTK. All cast the same rays in turns in one
 * process, their hits are compared before any time counts, and the ratios are taken round by round.
 *
 * Arguments: [rays = 300000] [rounds = 7] [scenes = 123] [rounds of building = 3]
 */
#include "AabbTreeCaster.h"
#include "BenchmarkScene.h"
#include "Contest.h"
#include "EmbreeCaster.h"
#include "Goals.h"
#include "LocatorCaster.h"
#include "OurCaster.h"
#include "Program.h"
#include "RaySet.h"
#include "Results.h"
#include "Timing.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>

using namespace irradiance;

namespace
{

const char* const kReference = "Embree rtcIntersect1";
const char* const kEmbreeTwoLevel = "Embree rtcIntersect1, mesh and instance";
const char* const kCgal = "CGAL AABB_tree";
const char* const kVtk = "VTK vtkStaticCellLocator";
const char* const kOurFlat = "ours, flat";
const char* const kOurTwoLevel = "ours, two-level";

constexpr std::size_t kAll = 0xffffffff;

std::vector<Contender> makeContenders(const BenchmarkScene& scene)
{
  const SceneObjects flat = flattened(scene.objects);
  const auto flatEmbree = std::make_shared<const EmbreeScene>(flat);
  const auto embree = std::make_shared<const EmbreeScene>(scene.objects);
  const auto makeEmbree = [](const char* name, auto target, RaysPerCall raysPerCall) {
    return Contender{ std::make_shared<EmbreeCaster>(name, target, raysPerCall), kAll, 1e-4 };
  };
  std::vector<Contender> contenders = {
    makeEmbree(kReference, flatEmbree, RaysPerCall::One),
    makeEmbree(kEmbreeTwoLevel, embree, RaysPerCall::One),
    makeEmbree("Embree rtcIntersect8", flatEmbree, RaysPerCall::Eight),
    makeEmbree("Embree rtcIntersect16", flatEmbree, RaysPerCall::Sixteen),
    { std::make_shared<AabbTreeCaster>(kCgal, flat.staticObject.body->mesh()), 4000, 2e-3 },
    { std::make_shared<LocatorCaster>(kVtk, flat.staticObject.body->mesh()), 1000, 2e-3 },
  };
  const auto ourFlat = makeScene(flat), ourTwoLevel = makeScene(scene.objects);
  for (const SimdChoice& choice : simdChoices())
  {
    contenders.push_back({ std::make_shared<OurCaster>(kOurFlat, ourFlat, choice), kAll, 1e-4 });
    contenders.push_back(
      { std::make_shared<OurCaster>(kOurTwoLevel, ourTwoLevel, choice), kAll, 1e-4 });
  }
  return contenders;
}

/// Seconds a ray in each round, of each rival on each set of rays.
using Seconds = std::map<std::string, std::vector<std::vector<double>>>;

void castSets(const BenchmarkScene& scene, int number, std::uint32_t count, int rounds,
  Results& results, Seconds& seconds)
{
  const std::vector<Contender> contenders = makeContenders(scene);
  for (const RaySet set : raySetsOf(scene))
  {
    const std::string column = std::to_string(number) + ' ' + letterOf(set);
    const std::vector<Performance> performances =
      compete(contenders, makeRays(scene, set, count), rounds);
    for (std::size_t i = 0; i < contenders.size(); ++i)
    {
      const std::string& name = contenders[i].caster->name();
      const std::vector<double>& own = performances[i].seconds;
      seconds[name].push_back(own);
      results.add("RayCastingSets", name, column, ratios(performances[0].seconds, own));
      results.add(
        "RayCastingRates", name, column, ratios(std::vector<double>(own.size(), 1e-6), own));
      results.add("RayCastingMismatches", name, column, { performances[i].mismatches });
    }
    std::printf("%s: rays %s done\n", scene.name.c_str(), column.c_str());
    std::fflush(stdout);
  }
}

/// Speed of `name` over that of `rival`: [set][round].
std::vector<std::vector<double>> speedsOf(
  const Seconds& seconds, const std::string& name, const std::string& rival)
{
  const auto &own = seconds.at(name), &other = seconds.at(rival);
  std::vector<std::vector<double>> speeds;
  for (std::size_t set = 0; set < own.size(); ++set)
  {
    speeds.push_back(ratios(other[set], own[set]));
  }
  return speeds;
}

/// The geometric mean over all sets of rays.
void addMean(
  const Seconds& seconds, const std::string& name, const char* rival, Goal goal, Results& results)
{
  if (seconds.count(name) == 0)
  {
    return; // not on this machine
  }
  results.add("RayCasting", name, std::string("speed / ") + rival,
    geometricMeans(speedsOf(seconds, name, rival)), goal);
}

/// The set of rays with the smallest median.
void addWorst(
  const Seconds& seconds, const std::string& name, const char* rival, Goal goal, Results& results)
{
  const std::vector<std::vector<double>> speeds = speedsOf(seconds, name, rival);
  results.add("RayCasting", name + ", worst set", std::string("speed / ") + rival,
    *std::min_element(speeds.begin(), speeds.end(),
      [](const auto& a, const auto& b) { return spreadOf(a).median < spreadOf(b).median; }),
    goal);
}

void addMeans(const Seconds& seconds, Results& results)
{
  const bool isAvx512 = simdChoices().front().level == SimdLevel::Avx512;
  addMean(seconds, kOurFlat, kReference, isAvx512 ? goals::kFlat : goals::kFlatAvx2, results);
  addWorst(seconds, kOurFlat, kReference, isAvx512 ? goals::kFlatWorst : Goal{}, results);
  addMean(seconds, std::string(kOurFlat) + ", AVX2", kReference, goals::kFlatAvx2, results);
  addMean(seconds, std::string(kOurFlat) + ", plain", kReference, {}, results);
  addMean(seconds, kOurTwoLevel, kEmbreeTwoLevel, goals::kTwoLevel, results);
  addMean(seconds, std::string(kOurTwoLevel) + ", AVX2", kEmbreeTwoLevel, {}, results);
  addMean(seconds, std::string(kOurTwoLevel) + ", plain", kEmbreeTwoLevel, {}, results);
  addMean(seconds, kOurFlat, kCgal, goals::kFlatOverCgal, results);
  addMean(seconds, kOurFlat, kVtk, goals::kFlatOverVtk, results);
  for (const auto& [name, perSet] : seconds)
  {
    if (name.find("ours") != 0 && name != kReference)
    {
      addMean(seconds, name, kReference, {}, results);
    }
  }
}

/// Both build on this thread alone, from the same triangles to what rays can be cast at.
void timeBuilds(const SceneObject& object, int rounds, Results& results)
{
  const std::vector<std::vector<double>> seconds =
    timeInTurns({ [&] {
                   EmbreeScene({ { object.body, nullptr, {} }, {} });
                 },
                  [&] { treeOf(object.body->mesh().triangles()); } },
      rounds);
  results.add("TreeBuild", "ours", "time / Embree's, HIGH quality", ratios(seconds[1], seconds[0]),
    goals::kTreeBuild);
  results.add("TreeBuild", "ours", "s", seconds[1]);
  results.add("TreeBuild", "Embree, HIGH quality", "s", seconds[0]);
}

std::optional<BenchmarkScene> makeNumberedScene(char number)
{
  switch (number)
  {
    case '1':
      return makeBunnyScene();
    case '2':
      return makeDragonScene();
    default:
      return makeRandomScene();
  }
}

void run(int argc, char* argv[])
{
  const auto count =
    static_cast<std::uint32_t>(argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 300000);
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 7;
  const int buildRounds = argc > 4 ? std::atoi(argv[4]) : 3;
  flushDenormals();
  Results results("BenchmarkRayCasting");
  Seconds seconds;
  for (const char number : std::string(argc > 3 ? argv[3] : "123"))
  {
    const std::optional<BenchmarkScene> scene = makeNumberedScene(number);
    if (!scene)
    {
      std::printf("Scene %c is left out: Data/fetch-benchmark-meshes.sh gets its meshes\n", number);
      continue;
    }
    castSets(*scene, number - '0', count, rounds, results, seconds);
    if (number == '2' && buildRounds > 0)
    {
      timeBuilds(scene->objects.dynamicObjects[0], buildRounds, results);
    }
  }
  addMeans(seconds, results);
  results.finish();
}

}

int main(int argc, char* argv[])
{
  return runProgram(run, argc, argv);
}
