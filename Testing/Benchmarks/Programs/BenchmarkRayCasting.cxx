// SPDX-License-Identifier: BSD-3-Clause
/**
 * Closest hits per second on one thread: our trees, flat (all triangles static) and two-level (a
 * static and a dynamic tree), beside Embree, CGAL and VTK. Then section 2.5 of the paper: static
 * and dynamic triangles in one tree, in two trees searched one after the other, and side by side;
 * each dynamic triangle moves on its own, and the one tree is not rebuilt in these times.
 *
 * All cast the same rays in turns in one process, their hits are compared before any time counts,
 * and the ratios are taken round by round. A distance that differs by more than 1e-3, or a hit that
 * the other misses, is a mismatch; the three modes must find the same bits.
 *
 * Arguments: [rays = 300000] [rounds = 7] [scenes = 123: those beside the peers]
 */
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Measuring/Rounds.h"
#include "Rivals/EmbreeScene.h"
#include "Scene/Scene.h"
#include "Scenes/RaySet.h"
#include "Simd/SimdLevel.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <stdexcept>

using namespace irradiance;

namespace
{

/// A rival and what is asked of it.
struct Contender
{
  std::string name;
  Caster caster;
  double mostMismatches;           ///< as a share of the rays; 0: the same bits
  std::size_t mostRays = SIZE_MAX; ///< slow ones cast every n-th ray
};

bool differ(const Hit& a, const Hit& b)
{
  // Lengths below are rounding: the room has 10 m, and coordinates are floats.
  constexpr double kShortest = 0.01;
  return a && b ? std::abs(a.distance - b.distance) > 1e-3 * std::max(a.distance, kShortest)
                : bool(a) != bool(b);
}

/// `truth`: the hits of all rays, of which the contender has cast every n-th. A single mismatch is
/// forgiven where any are.
void requireHits(const Contender& contender, const std::vector<Hit>& truth,
  const std::vector<Hit>& hits, std::size_t n)
{
  const bool isExact = contender.mostMismatches == 0;
  std::size_t mismatches = 0;
  for (std::size_t i = 0; i < hits.size(); ++i)
  {
    mismatches += isExact ? truth[n * i] != hits[i] : differ(truth[n * i], hits[i]);
  }
  if (mismatches > (isExact ? 0 : 1) &&
    static_cast<double>(mismatches) > contender.mostMismatches * static_cast<double>(hits.size()))
  {
    throw std::runtime_error(contender.name + " finds other hits: " + std::to_string(mismatches) +
      " of " + std::to_string(hits.size()));
  }
}

/// Lets all cast the same rays, in turns; their hits are compared with the hits of the first.
/// Seconds a ray: [contender][round].
std::vector<std::vector<double>> compete(
  const std::vector<Contender>& contenders, const std::vector<Ray>& rays, int rounds)
{
  std::vector<std::vector<Hit>> hits(contenders.size());
  std::vector<std::function<void()>> jobs;
  for (std::size_t i = 0; i < contenders.size(); ++i)
  {
    const std::size_t n = std::max<std::size_t>(1, rays.size() / contenders[i].mostRays);
    std::vector<Ray> chosen;
    for (std::size_t ray = 0; ray < rays.size(); ray += n)
    {
      chosen.push_back(rays[ray]);
    }
    hits[i].resize(chosen.size());
    jobs.push_back([cast = contenders[i].caster(chosen), &found = hits[i]] { cast(found); });
    jobs.back()();
    requireHits(contenders[i], hits[0], hits[i], n);
  }
  std::vector<std::vector<double>> seconds = timeInTurns(jobs, rounds);
  for (std::size_t i = 0; i < contenders.size(); ++i)
  {
    for (double& each : seconds[i])
    {
      each /= static_cast<double>(hits[i].size());
    }
  }
  return seconds;
}

/// With its trees built, ready for casts.
std::shared_ptr<const Scene> makeScene(
  const SceneObjects& objects, TraversalMode mode = TraversalMode::Parallel)
{
  auto scene = std::make_shared<Scene>();
  scene->setTraversalMode(mode);
  scene->setStatic(objects.staticObject.body);
  scene->setDynamic(objects.dynamicBodies());
  scene->commit({});
  return scene;
}

/// Casts all rays by one call, with these instructions at best.
Caster makeOurCaster(std::shared_ptr<const Scene> scene, SimdLevel level)
{
  return [=](const std::vector<Ray>& rays) -> Cast {
    return [=](std::vector<Hit>& hits) {
      limitSimd(level);
      scene->cast(rays.data(), rays.size(), hits.data());
    };
  };
}

const std::string kReference = "Embree rtcIntersect1";
const std::string kEmbreeTwoLevel = "Embree rtcIntersect1, mesh and instance";
const std::string kCgal = "CGAL AABB_tree";
const std::string kVtk = "VTK vtkStaticCellLocator";
const std::string kOurFlat = "ours, flat";
const std::string kOurTwoLevel = "ours, two-level";

/// Instructions that our casts can be held to.
struct SimdChoice
{
  std::string name; ///< behind the rival's; empty for the best that the machine has
  SimdLevel level;
};

/// All that this machine has.
std::vector<SimdChoice> simdChoices()
{
  limitSimd(SimdLevel::Avx512);
  const SimdLevel best = simdLevel();
  std::vector<SimdChoice> choices = { { "", best }, { ", AVX2", SimdLevel::Avx2 },
    { ", plain", SimdLevel::Plain } };
  choices.erase(std::remove_if(choices.begin() + 1, choices.end(),
                  [&](const SimdChoice& choice) { return choice.level >= best; }),
    choices.end());
  return choices;
}

std::vector<Contender> makeContenders(const BenchmarkScene& scene)
{
  constexpr double kFew = 1e-4, kSome = 2e-3; // mismatches
  const SceneObjects flat = flattened(scene.objects);
  const TriangleMesh& mesh = flat.staticObject.body->mesh();
  const auto flatEmbree = std::make_shared<const EmbreeScene>(flat);
  const auto embree = std::make_shared<const EmbreeScene>(scene.objects);
  std::vector<Contender> contenders = {
    { kReference, makeEmbreeCaster<RTCRayHit>(flatEmbree), kFew },
    { kEmbreeTwoLevel, makeEmbreeCaster<RTCRayHit>(embree), kFew },
    { "Embree rtcIntersect8", makeEmbreeCaster<RTCRayHit8>(flatEmbree), kFew },
    { "Embree rtcIntersect16", makeEmbreeCaster<RTCRayHit16>(flatEmbree), kFew },
    { kCgal, makeCgalCaster(mesh), kSome, 4000 },
    { kVtk, makeVtkCaster(mesh), kSome, 1000 },
  };
  const auto ourFlat = makeScene(flat), ourTwoLevel = makeScene(scene.objects);
  for (const SimdChoice& choice : simdChoices())
  {
    contenders.push_back({ kOurFlat + choice.name, makeOurCaster(ourFlat, choice.level), kFew });
    contenders.push_back(
      { kOurTwoLevel + choice.name, makeOurCaster(ourTwoLevel, choice.level), kFew });
  }
  return contenders;
}

/// Seconds a ray, of each rival: [set][round].
using Seconds = std::map<std::string, std::vector<std::vector<double>>>;

void castSets(
  const BenchmarkScene& scene, char number, std::uint32_t count, int rounds, Seconds& seconds)
{
  const std::vector<Contender> contenders = makeContenders(scene);
  for (const RaySet& set : makeRaySets(scene, count))
  {
    const std::string column = { number, ' ', set.letter };
    const std::vector<std::vector<double>> found = compete(contenders, set.rays, rounds);
    for (std::size_t i = 0; i < contenders.size(); ++i)
    {
      const std::string& name = contenders[i].name;
      seconds[name].push_back(found[i]);
      report("RayCastingSets", name, column, ratios(found[0], found[i]));
      report("RayCastingRates", name, column, ratios(1e-6, found[i]));
    }
    std::clog << scene.name << ": rays " << column << " done\n";
  }
}

/// Speed of `name` over the speed of `rival`: [set][round].
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
void reportMean(
  const Seconds& seconds, const std::string& name, const std::string& rival, const Goal& goal = {})
{
  report(
    "RayCasting", name, "speed / " + rival, geometricMeans(speedsOf(seconds, name, rival)), goal);
}

void reportMeans(const Seconds& seconds)
{
  for (const SimdChoice& choice : simdChoices())
  {
    const bool isBest = choice.name.empty();
    reportMean(seconds, kOurFlat + choice.name, kReference,
      choice.level == SimdLevel::Avx512   ? Goal{ 1.15, 1.4 }
        : choice.level == SimdLevel::Avx2 ? Goal{ 0.7, 1.0 }
                                          : Goal{});
    reportMean(
      seconds, kOurTwoLevel + choice.name, kEmbreeTwoLevel, isBest ? Goal{ 1.2, 1.5 } : Goal{});
    if (isBest)
    {
      const std::vector<std::vector<double>> speeds = speedsOf(seconds, kOurFlat, kReference);
      report("RayCasting", kOurFlat + ", worst set", "speed / " + kReference,
        *std::min_element(speeds.begin(), speeds.end(),
          [](const auto& a, const auto& b) { return medianOf(a) < medianOf(b); }),
        choice.level == SimdLevel::Avx512 ? Goal{ 0.9, 1.25 } : Goal{});
    }
  }
  reportMean(seconds, kOurFlat, kCgal, { 12, 25 });
  reportMean(seconds, kOurFlat, kVtk, { 30, 50 });
  for (const auto& [name, perSet] : seconds)
  {
    if (name.find("ours") != 0 && name != kReference)
    {
      reportMean(seconds, name, kReference);
    }
  }
}

/// Both build on this thread alone, from the same triangles to what rays can be cast at.
void timeBuilds(const SceneObject& object, int rounds)
{
  const std::vector<std::vector<double>> seconds =
    timeInTurns({ [&] {
                   EmbreeScene({ object, {} });
                 },
                  [&] { treeOf(object.body->mesh().triangles()); } },
      rounds);
  report(
    "TreeBuild", "ours", "time / Embree's, HIGH quality", ratios(seconds[1], seconds[0]), { 4, 2 });
  report("TreeBuild", "ours", "s", seconds[1]);
  report("TreeBuild", "Embree, HIGH quality", "s", seconds[0]);
}

void compareModes(const BenchmarkScene& scene, std::uint32_t count, int rounds)
{
  std::vector<Contender> contenders;
  for (const auto& [name, mode] : { std::pair{ "one tree", TraversalMode::OneTree },
         { "sequential", TraversalMode::Sequential }, { "parallel", TraversalMode::Parallel } })
  {
    contenders.push_back(
      { name, makeOurCaster(makeScene(scene.objects, mode), SimdLevel::Avx512), 0 });
  }
  std::vector<std::vector<double>> overOneTree, overSequential; // [set][round]
  for (const RaySet& set : makeRaySets(scene, count))
  {
    const std::vector<std::vector<double>> seconds = compete(contenders, set.rays, rounds);
    for (std::size_t i = 0; i < contenders.size(); ++i)
    {
      report("TraversalModesSets", contenders[i].name, scene.name + ", " + set.letter,
        ratios(seconds[i], seconds[0]));
    }
    overOneTree.push_back(ratios(seconds[0], seconds[2]));
    overSequential.push_back(ratios(seconds[1], seconds[2]));
  }
  const std::string row = "parallel: " + scene.name;
  report("TraversalModes", row, "speed / one tree", geometricMeans(overOneTree), { 0.9, 1.0 });
  report("TraversalModes", row, "speed / sequential", geometricMeans(overSequential), { 1.0, 1.1 });
}

}

void run(const Arguments& arguments)
{
  const auto count = arguments.number(0, 300000u);
  const int rounds = arguments.number(1, 7);
  flushDenormals();
  Seconds seconds;
  for (const char number : arguments.text(2, "123"))
  {
    const std::optional<BenchmarkScene> scene =
      number == '3' ? makeRandomScene() : makeRoomScene(number == '2');
    if (!scene)
    {
      std::clog << "Scene " << number
                << " is left out: Data/fetch-benchmark-meshes.sh gets its meshes\n";
      continue;
    }
    castSets(*scene, number, count, rounds, seconds);
    if (number == '2')
    {
      timeBuilds(scene->objects.dynamicObjects[0], rounds);
    }
  }
  reportMeans(seconds);
  compareModes(makeTeapotsScene(), count, rounds);
  compareModes(makeRandomScene(true), count, rounds);
}
