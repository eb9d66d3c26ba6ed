// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_test_DirectRuns_h
#define irradiance_test_DirectRuns_h

#include "EngineRun.h"
#include "TestScenes.h"
#include "ThreadExecution.h"
#include "Walks/DirectSources.h"

namespace irradiance::test
{

/// As many walks with sanitizers: they decide which cells are small.
inline EngineSettings gathering(std::uint32_t walks, std::uint64_t seed = 1)
{
  EngineSettings settings;
  settings.numberOfWalks = walks;
  settings.seed = seed;
  settings.gathersDirectLight = true;
  settings.cellEstimate = CellEstimate::Gathered;
  return settings;
}

/// What an engine shoots and gathers.
inline std::vector<WalkSource> gatheredOf(const SceneObjects& objects, const WalkPlan& plan)
{
  const std::vector<WalkSource> sources = sourcesOf(objects, plan);
  return directSourcesOf(objects, sources, LightSurvey(objects, sources), {});
}

/// Of what the walks of a source bring.
inline double quantaPerWatt(const WalkSource& source)
{
  return static_cast<double>(source.lights.quantaPerWalk()) * source.plan.walksAfter(1) /
    source.lights.flux();
}

/// What seeds find of each cell, in one band.
class SeedMeans
{
public:
  void add(const IrradianceEngine& engine, int band = 0)
  {
    std::size_t i = 0;
    engine.cells().numbers().forEach([&](const SceneCell& cell) {
      means_.resize(std::max(means_.size(), i + 1));
      means_[i++].add(engine.irradiance({ cell }, band));
    });
  }
  const std::vector<ReplicateMean>& cells() const { return means_; }

private:
  std::vector<ReplicateMean> means_;
};

/// W on the cells of an object, as estimated.
inline double estimatedWattsOn(const IrradianceEngine& engine, std::uint32_t object, int band)
{
  double watts = 0;
  for (std::size_t cell = 0; cell < engine.cells().numbers().sizeOf(object); ++cell)
  {
    watts += engine.irradiance({ { object, cell } }, band) * engine.cells().area({ object, cell });
  }
  return watts;
}

/// Every cell emits what it does not reflect, 1 - reflectance, so E = 1 everywhere.
inline SceneObject furnace(ObjectBuilder builder, double reflectance, const AffineMap& pose = {})
{
  std::vector<double>& ofCells = builder.material().reflectance;
  std::fill(ofCells.begin(), ofCells.end(), reflectance);
  builder.emission().exitance.assign(ofCells.size(), 1 - reflectance);
  return builder.build(pose);
}

/// Cells of two engines agree to 5.5 standard errors of both; returns how many have an error bar.
inline int expectAgreement(const IrradianceEngine& a, const IrradianceEngine& b)
{
  const ErrorEstimate ofA = a.errorEstimate(), ofB = b.errorEstimate();
  int compared = 0;
  a.cells().numbers().forEach([&](const SceneCell& cell) {
    const CellSide side{ cell };
    const double bar =
      std::hypot(a.watts(ofA.standardError(side, 0)), b.watts(ofB.standardError(side, 0))) /
      a.cells().area(cell);
    if (a.cells().area(cell) > 0 && !std::isnan(bar))
    {
      EXPECT_NEAR(b.irradiance(side, 0), a.irradiance(side, 0), 5.5 * bar)
        << "cell " << cell.cell << " of object " << cell.object;
      ++compared;
    }
  });
  return compared;
}

/// From so many seeds.
inline SeedMeans meansOf(
  const SceneObjects& objects, int seeds, EngineSettings settings, std::uint64_t firstSeed = 1)
{
  SeedMeans means;
  settings.seed = firstSeed;
  overSeeds(
    objects, seeds, settings, [&](const IrradianceEngine& engine) { means.add(engine); },
    ThreadExecution(2));
  return means;
}

/// Of the cells from `first` on: chi-square of the differences of two means.
inline double chiSquareOf(const SeedMeans& a, const SeedMeans& b, std::size_t first)
{
  double sum = 0;
  for (std::size_t i = first; i < a.cells().size(); ++i)
  {
    const ReplicateMean &x = a.cells()[i], &y = b.cells()[i];
    sum += std::pow(x.mean() - y.mean(), 2) /
      (std::pow(x.standardError(), 2) + std::pow(y.standardError(), 2));
  }
  return sum;
}

}

#endif
