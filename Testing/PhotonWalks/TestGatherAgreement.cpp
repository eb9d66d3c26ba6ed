// SPDX-License-Identifier: BSD-3-Clause
// The final gather beside what has no bias, and what it says of its own.

#include "FinalGather/CellRoles.h"
#include "GatherScenes.h"

#include "../RayCasting/TestMeshes.h"

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>

namespace irradiance
{

namespace
{

using test::gathering;
using test::GatherTestScene;
using test::grey;
using test::ReplicateMean;

/// The mean irradiance of the cells that gather with these settings, W/m2, all bands together.
double meanOnGatherers(const IrradianceEngine& engine, const EngineSettings& settings)
{
  const CellRoles roles(
    engine.cells(), settings.numberOfWalks, settings.gatherRays, settings.gatherOn);
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

/// What seeds find.
struct Found
{
  ReplicateMean irradiance; ///< of the cells that gather, W/m2
  ReplicateMean bias;       ///< relative, as stated
  ReplicateMean claimed;    ///< its standard error
};

Found foundBy(const SceneObjects& objects, EngineSettings settings, int seeds)
{
  Found found;
  settings.verify = false;
  settings.replicates = 16;
  for (int i = 0; i < seeds; ++i, ++settings.seed)
  {
    IrradianceEngine engine;
    test::ThreadExecution two(2);
    engine.update(objects, settings, two);
    found.irradiance.add(meanOnGatherers(engine, settings));
    found.bias.add(engine.gatheringBias().mean);
    found.claimed.add(engine.gatheringBias().standardError);
  }
  return found;
}

}

// Less the bias that it states, the final gather finds what it finds where it reads nothing, and
// that finds what is known by closed forms. VTKIRRADIANCE_TEST_EFFORT=6 takes 24 seeds and four
// times the rays. |t| > 9 of six degrees of freedom by chance once in 9,000 for each of twelve; of
// 46 far less often.
TEST(GatherAgreement, IsThatOfTheStatedBias)
{
  const int seeds = 4 * test::effort();
  EngineSettings settings = gathering(20000);
  settings.gatherRays = test::effort() > 1 ? 256 : 64;
  std::vector<GatherTestScene> scenes = test::gatherScenes();
  scenes.resize(test::kIsSanitized ? 3 : scenes.size());
  for (const GatherTestScene& scene : scenes)
  {
    const Found gathered = foundBy(scene.objects, settings, seeds);
    EngineSettings unbiasedSettings = settings;
    unbiasedSettings.unbiasedGather = true;
    unbiasedSettings.seed = 1001;
    const Found unbiased = foundBy(scene.objects, unbiasedSettings, seeds);
    EXPECT_EQ(unbiased.bias.mean(), 0) << "nothing is read";
    EXPECT_EQ(unbiased.claimed.mean(), 0);
    const double truth = unbiased.irradiance.mean();
    const double off = gathered.irradiance.mean() / truth - 1;
    const double noise =
      std::hypot(gathered.irradiance.standardError(), unbiased.irradiance.standardError()) / truth;
    std::printf(
      "%-10s off by %+.2f +- %.2f %%, bias stated %+.2f +- %.2f %%, claimed of one %.2f\n",
      scene.name, 100 * off, 100 * noise, 100 * gathered.bias.mean(),
      100 * gathered.bias.standardError(), 100 * gathered.claimed.mean());
    EXPECT_LT(
      std::abs(off - gathered.bias.mean()), 9 * std::hypot(noise, gathered.bias.standardError()))
      << scene.name;
    EXPECT_LT(noise, 0.1) << "else a test of nothing";
    if (scene.truth > 0)
    {
      EXPECT_LT(std::abs(unbiased.irradiance.t(scene.truth)), 12) << scene.name;
    }
  }
}

namespace
{

/// A cube of n x n cells a wall that a panel lights, and a ball in it.
SceneObjects cubeWithBall(int n)
{
  test::ObjectBuilder room, ball;
  room.addBox(test::box({ 0, 0, 0 }, { 4, 4, 4 }), n, grey(0.5), true);
  room.addQuad({ 1, 1, 3.9 }, { 0, 2, 0 }, { 2, 0, 0 }, 1, 1, grey(0, 10));
  ball.addSphere({ 0, 0, 0 }, 0.4, 4, grey(0.5));
  return { room.build(), { ball.build(test::shift({ 2, 2, 1.8 })) } };
}

}

// As the square of the size of cells: with half of it a quarter is left. 5 standard errors by
// chance once in 10^4, as they have thirty degrees of freedom.
TEST(GatherAgreement, StatedBiasShrinksWithTheCellsThatAreRead)
{
  const auto statedWith = [](int cells, std::uint32_t rays) {
    EngineSettings settings = gathering(40000);
    settings.gatherRays = test::scaled(rays);
    settings.gatherOn = GatherOn::All;
    return foundBy(cubeWithBall(cells), settings, 3);
  };
  const Found coarse = statedWith(4, 2048), fine = statedWith(8, 512);
  for (const Found& found : { coarse, fine })
  {
    std::printf("bias stated %+.3f +- %.3f %%, of three\n", 100 * found.bias.mean(),
      100 * found.claimed.mean() / std::sqrt(3));
  }
  const double noise = std::hypot(fine.claimed.mean(), coarse.claimed.mean() / 4) / std::sqrt(3);
  EXPECT_LT(std::abs(fine.bias.mean() - coarse.bias.mean() / 4), 5 * noise);
  if (!test::kIsSanitized) // else too few are checked
  {
    EXPECT_LT(coarse.bias.mean() + 4 * coarse.claimed.mean() / std::sqrt(3), 0) << "there is one";
    EXPECT_LT(noise, 0.25 * std::abs(coarse.bias.mean())) << "else a test of nothing";
  }
}

namespace
{

/// Of the cells of dynamic objects: how many intervals there are, are known, and hold the truth.
struct Held
{
  double all = 0, known = 0, plain = 0;
  double widened = 0; ///< by the bias that is stated
};

/// `truth`: of all cells; its own noise counts as well. `bias`: relative.
void countHeld(
  const IrradianceEngine& engine, const test::SeedMeans& truth, double bias, Held& held)
{
  const double factor = ErrorEstimate::confidenceFactor(16);
  const ErrorEstimate errors = engine.errorEstimate();
  std::size_t number = 0;
  engine.cells().numbers().forEach([&](const SceneCell& cell) {
    const ReplicateMean& right = truth.cells()[number++];
    if (cell.object == 0)
    {
      return;
    }
    const double found = engine.irradiance({ cell }, 0);
    const double error =
      engine.watts(errors.standardError({ cell }, 0)) / engine.cells().area(cell);
    held.all += 1;
    if (!std::isnan(error))
    {
      const double off = std::abs(found - right.mean());
      const double reach = factor * std::hypot(error, right.standardError());
      held.known += 1;
      held.plain += off <= reach ? 1 : 0;
      held.widened += off <= reach + std::abs(bias) * found ? 1 : 0;
    }
  });
}

}

// 95 % are asked for; with the few samples of a net to a replicate intervals are wider, see
// Theory.md, 5.7. Some 370 of them, which hold the truth in 98 % and scatter by .8 %, and by twice
// that as those of a seed read the same sums: below 93 % by chance once in 10^3.
// VTKIRRADIANCE_TEST_EFFORT=2 takes all scenes and twice the seeds.
TEST(GatherAgreement, IntervalsAndBiasHoldTheTruth)
{
  const int seeds = 4 * test::effort();
  EngineSettings settings = gathering(20000);
  settings.verify = false;
  std::map<std::uint32_t, Held> held; // by rays
  for (const GatherTestScene& scene : test::gatherScenes())
  {
    const std::string name = scene.name;
    const bool isQuick = name == "corner" || name == "sheet" ||
      (!test::kIsSanitized && (name == "area lamp" || name == "points"));
    if (!isQuick && (test::effort() == 1 || name == "furnace" || name == "bands"))
    {
      continue;
    }
    EngineSettings unbiased = settings;
    unbiased.unbiasedGather = true;
    unbiased.gatherRays = 128 * static_cast<std::uint32_t>(test::effort());
    const test::SeedMeans truth = test::meansOf(scene.objects, seeds, unbiased, 1001);
    for (const std::uint32_t rays : { 16u, 32u })
    {
      settings.gatherRays = rays;
      settings.replicates = 16;
      std::vector<std::unique_ptr<IrradianceEngine>> engines;
      ReplicateMean bias;
      for (settings.seed = 1; settings.seed <= static_cast<std::uint64_t>(seeds); ++settings.seed)
      {
        engines.push_back(std::make_unique<IrradianceEngine>());
        test::ThreadExecution two(2);
        engines.back()->update(scene.objects, settings, two);
        bias.add(engines.back()->gatheringBias().mean);
      }
      for (const auto& engine : engines)
      {
        countHeld(*engine, truth, bias.mean(), held[rays]);
      }
    }
  }
  for (const auto& [rays, of] : held)
  {
    const double plain = of.plain / of.known, widened = of.widened / of.known;
    std::printf(
      "%u rays: %.0f of %.0f intervals known, %.1f %% hold the truth, %.1f %% with the bias\n",
      rays, of.known, of.all, 100 * plain, 100 * widened);
    // The two scenes of sanitized runs have many cells in corners, where little arrives.
    EXPECT_GT(of.known, (test::kIsSanitized ? 0.6 : 0.8) * of.all);
    EXPECT_GT(widened, 0.93);
    EXPECT_GE(widened, plain);
  }
}

}
