// SPDX-License-Identifier: BSD-3-Clause
// The final gather beside what has no bias.

#include "FinalGather/CellRoles.h"
#include "Kit.h"

#include "../RayCasting/TestMeshes.h"

namespace irradiance::test
{
namespace
{

/// The mean irradiance of the cells that gather with these settings, W/m2, all bands together.
double meanOnGatherers(const IrradianceEngine& engine, const EngineSettings& settings)
{
  const CellRoles roles(
    engine.cells(), settings.numberOfWalks, settings.gatherRays, settings.gathersEverywhere);
  double watts = 0, area = 0;
  engine.cells().numbers().forEach([&](const SceneCell& cell) {
    for (int band = 0; roles.gathers(cell) && band < engine.sums().bands(); ++band)
    {
      watts += engine.irradiance({ cell }, band) * engine.cells().area(cell);
      area += engine.cells().area(cell);
    }
  });
  return watts / area;
}

/// What seeds find, W/m2.
ReplicateMean foundBy(const SceneObjects& objects, EngineSettings settings, int seeds)
{
  ReplicateMean found;
  settings.replicates = 16;
  overSeeds(
    objects, seeds, settings,
    [&](const IrradianceEngine& engine) { found.add(meanOnGatherers(engine, settings)); },
    ThreadExecution(2));
  return found;
}

/// Of means of cells that rays read, relative: the most on the cells of these scenes. See
/// SpeedAndAccuracy.md for what BenchmarkDefault measures.
constexpr double kMostBias = 0.03;

// But for a small bias the final gather finds what it finds where it reads nothing, and that finds
// what is known by closed forms. VTKIRRADIANCE_TEST_EFFORT=6 takes 24 seeds and four times the
// rays. |t| > 9 of six degrees of freedom by chance once in 9,000 for each of twelve; of 46 far
// less often.
TEST(FinalGatherAgreement, IsThatOfPathsThatReadNothing)
{
  const int seeds = 4 * effort();
  EngineSettings settings = gathering(20000);
  settings.gatherRays = effort() > 1 ? 256 : 64;
  std::vector<GatherTestScene> scenes = gatherScenes();
  scenes.resize(kIsSanitized ? 3 : scenes.size());
  for (const GatherTestScene& scene : scenes)
  {
    const ReplicateMean gathered = foundBy(scene.objects, settings, seeds);
    EngineSettings unbiasedSettings = settings;
    unbiasedSettings.unbiasedGather = true;
    unbiasedSettings.seed = 1001;
    const ReplicateMean unbiased = foundBy(scene.objects, unbiasedSettings, seeds);
    const double off = gathered.mean() / unbiased.mean() - 1;
    const double noise =
      std::hypot(gathered.standardError(), unbiased.standardError()) / unbiased.mean();
    EXPECT_LT(std::abs(off), kMostBias + 9 * noise) << scene.name;
    EXPECT_LT(noise, 0.1) << "else a test of nothing";
    if (scene.truth > 0)
    {
      EXPECT_LT(std::abs(unbiased.t(scene.truth)), 12) << scene.name;
    }
  }
}

/// Of the cells of dynamic objects: how many intervals there are, are known, and hold the truth.
struct GatheredHeld
{
  double all = 0, known = 0, right = 0;

  /// `truth`: of all cells; its own noise counts as well, and the bias, which error bars do not
  /// hold.
  void add(const IrradianceEngine& engine, const SeedMeans& truth)
  {
    const double factor = ErrorEstimate::confidenceFactor(16);
    const ErrorEstimate errors = engine.errorEstimate();
    engine.cells().numbers().forEach([&](const SceneCell& cell) {
      const ReplicateMean& mean = truth.cells()[engine.cells().numbers()[cell]];
      const double found = engine.irradiance({ cell }, 0);
      const double error =
        engine.watts(errors.standardError({ cell }, 0)) / engine.cells().area(cell);
      const double reach = factor * std::hypot(error, mean.standardError());
      all += cell.object > 0 ? 1 : 0;
      known += cell.object > 0 && !std::isnan(error) ? 1 : 0;
      right +=
        cell.object > 0 && std::abs(found - mean.mean()) <= reach + kMostBias * found ? 1 : 0;
    });
  }
};

// 95 % are asked for; with the few samples of a net to a replicate intervals are wider, see
// Theory.md, 5.7. Some 370 of them, which hold the truth in 98 % and scatter by .8 %, and by twice
// that as those of a seed read the same sums: below 93 % by chance once in 10^3.
// VTKIRRADIANCE_TEST_EFFORT=2 takes all scenes and twice the seeds.
TEST(FinalGatherAgreement, IntervalsHoldTheTruth)
{
  const int seeds = 4 * effort();
  EngineSettings settings = gathering(20000);
  std::map<std::uint32_t, GatheredHeld> held; // by rays
  for (const GatherTestScene& scene : gatherScenes())
  {
    const std::string name = scene.name;
    const bool isQuick = name == "corner" || name == "sheet" ||
      (!kIsSanitized && (name == "area lamp" || name == "points"));
    if (!isQuick && (effort() == 1 || name == "furnace" || name == "bands"))
    {
      continue;
    }
    EngineSettings unbiased = settings;
    unbiased.unbiasedGather = true;
    unbiased.gatherRays = 128 * static_cast<std::uint32_t>(effort());
    const SeedMeans truth = meansOf(scene.objects, seeds, unbiased, 1001);
    for (const std::uint32_t rays : { 16u, 32u })
    {
      settings.gatherRays = rays;
      settings.replicates = 16;
      overSeeds(
        scene.objects, seeds, settings,
        [&](const IrradianceEngine& engine) { held[rays].add(engine, truth); }, ThreadExecution(2));
    }
  }
  for (const auto& [rays, of] : held)
  {
    // The two scenes of sanitized runs have many cells in corners, where little arrives.
    EXPECT_GT(of.known, (kIsSanitized ? 0.6 : 0.8) * of.all);
    EXPECT_GT(of.right / of.known, 0.93);
  }
}

}
}
