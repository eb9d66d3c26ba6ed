// SPDX-License-Identifier: BSD-3-Clause
#include "Kit.h"
#include "LambertContour.h"

// What a cell gathers is right however small a part of all power it is: below a light that is far
// away, or on a cell that is tiny beside the walls.

namespace irradiance::test
{
namespace
{

const CellEstimate kEstimates[] = { CellEstimate::Sums, CellEstimate::Spread,
  CellEstimate::Gathered };

EngineSettings faintSettings(
  CellEstimate estimate, std::uint32_t replicates, std::uint64_t seed = 1)
{
  EngineSettings settings = gathering(2000, seed);
  settings.cellEstimate = estimate;
  settings.replicates = replicates;
  settings.gatherRays = 16;
  return settings;
}

/// The form factor of a rectangle at height h, with corners at (x, y), to a facet that looks up at
/// 0.
double seenAbove(double x0, double x1, double y0, double y1, double h)
{
  const auto corner = [h](double x, double y) {
    const double u = x / h, v = y / h, p = std::hypot(1, u), q = std::hypot(1, v);
    return (u / p * std::atan(v / p) + v / q * std::atan(u / q)) / (2 * M_PI);
  };
  return corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0);
}

/// A square of n x n cells around a place, which looks up or down.
SceneObject plate(const Vector3& center, double side, int n, bool isUp, double reflectance = 0)
{
  ObjectBuilder builder;
  const Vector3 u(side, 0, 0), v(0, isUp ? side : -side, 0);
  builder.addQuad(-0.5 * (u + v), u, v, n, n, grey(reflectance));
  return builder.build(shift(center));
}

// The point light of each distance brings 1000 W/m2 across its beam.
TEST(FaintLight, APointLightMayBeAsFarAsItLikes)
{
  const Vector3 towards(0.48, 0.6, 0.64);
  for (const double distance : { 300.0, 2e4, 1e8, 1e13 })
  {
    ObjectBuilder land;
    land.addQuad({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 3, 3, grey(0));
    const double flux = 1000 * 4 * M_PI * distance * distance;
    land.addPointLight(distance * towards, flux);
    const SceneObjects objects{ land.build(), { plate({ 2, 0, 0.5 }, 0.01, 2, true) } };
    for (const CellEstimate estimate : kEstimates)
    {
      for (const std::uint32_t replicates : { 1u, 16u })
      {
        UpdatedEngine engine(objects, faintSettings(estimate, replicates));
        engine.cells().numbers().forEach([&](const SceneCell& cell) {
          const SceneObject& object = objects[cell.object];
          double seen = 0;
          for (const std::size_t number : { 2 * cell.cell, 2 * cell.cell + 1 })
          {
            const Triangle& own = object.mesh()[number];
            const AffineMap& map = object.worldFromObject;
            seen += solidAngleOf({ map(own.a), map(own.b), map(own.c) }, distance * towards);
          }
          const double truth = flux * seen / (4 * M_PI) / engine.cells().area(cell);
          EXPECT_NEAR(engine.irradiance({ cell }, 0) / truth, 1, 1e-6)
            << distance << " m, estimate " << int(estimate) << ", " << replicates;
          const double error = engine.watts(engine.errorEstimate().standardError({ cell }, 0));
          EXPECT_TRUE(std::isnan(error) || error <= 1e-6 * truth) << distance;
        });
      }
    }
  }
}

// A black plate in a black room of 4 m, below a panel of 1 m. 8 seeds, |t| > 7 in one of 18 cases:
// a false alarm in .4 %.
TEST(FaintLight, CellsMayBeAsSmallAsTheyLike)
{
  const double truth = 30 * seenAbove(-0.2, 0.8, -0.3, 0.7, 2.5);
  for (const double side : { 4e-3, 4e-6, 4e-9 })
  {
    ObjectBuilder room;
    room.addBox(box({ -2, -2, 0 }, { 2, 2, 4 }), 2, grey(0), true);
    room.addQuad({ -0.2, -0.3, 3.5 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1, grey(0, 30));
    const SceneObjects objects{ room.build(), { plate({ 0, 0, 1 }, side, 3, true) } };
    for (const CellEstimate estimate : kEstimates)
    {
      for (const std::uint32_t replicates : { 1u, 8u })
      {
        ReplicateMean mean;
        IntervalCount intervals(8);
        for (std::uint64_t seed = 1; seed <= 8; ++seed)
        {
          UpdatedEngine engine(objects, faintSettings(estimate, replicates, seed));
          mean.add(estimatedWattsOn(engine, 1, 0) / (side * side));
          const ErrorEstimate errors = engine.errorEstimate();
          for (std::size_t cell = 0; cell < 9; ++cell)
          {
            const double area = engine.cells().area({ 1, cell });
            const double error = engine.watts(errors.standardError({ { 1, cell } }, 0)) / area;
            intervals.add(engine.irradiance({ { 1, cell } }, 0) - truth, error);
          }
        }
        const std::string name = std::to_string(1e9 * side) + " nm, estimate " +
          std::to_string(int(estimate)) + ", " + std::to_string(replicates);
        EXPECT_LT(std::abs(mean.t(truth)), 7) << name;
        EXPECT_FALSE(intervals.shareThatHolds() < 0.8) << name;
      }
    }
  }
}

// What a floor sends up to a small plate, below a far light: rays read what the floor gathered. 16
// seeds,
// |t| > 5.5: a false alarm in .03 %.
TEST(FaintLight, RaysReadIt)
{
  const double truth = 0.5 * 640 * seenAbove(-1, 1, -1, 1, 0.4);
  const Vector3 towards(0.48, 0.6, 0.64);
  for (const double distance : { 1e4, 1e9 })
  {
    ObjectBuilder floor;
    floor.addQuad({ -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 2, 2, grey(0.5));
    floor.addPointLight(distance * towards, 1000 * 4 * M_PI * distance * distance);
    const SceneObjects objects{ floor.build(), { plate({ 0, 0, 0.4 }, 1e-4, 3, false) } };
    for (const std::uint32_t replicates : { 1u, 8u })
    {
      ReplicateMean mean;
      for (std::uint64_t seed = 1; seed <= 16; ++seed)
      {
        EngineSettings settings = faintSettings(CellEstimate::Gathered, replicates, seed);
        settings.separateSides = true;
        const UpdatedEngine engine(objects, settings);
        for (std::size_t cell = 0; cell < 9; ++cell)
        {
          mean.add(engine.irradiance({ { 1, cell }, 0 }, 0));
        }
      }
      EXPECT_LT(std::abs(mean.t(truth)), 5.5) << distance << ' ' << replicates;
    }
  }
}

// Two mirrors that face each other, a point light between: what leaves them at the sides falls on
// black walls. The walks that start at the mirrors are as many as if they were shot, and as
// different.
TEST(FaintLight, WalksOfAMirrorDiffer)
{
  ObjectBuilder room;
  Look mirror;
  mirror.specular = { 0.95, 0.95, 0.95 };
  room.addQuad({ -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 1, 1, mirror);
  room.addQuad({ -1, -1, 1 }, { 0, 2, 0 }, { 2, 0, 0 }, 1, 1, mirror);
  for (int side = 0; side < 4; ++side)
  {
    room.addSide(box({ -1, -1, 0 }, { 1, 1, 1 }), side, 4, grey(0), true);
  }
  room.addPointLight({ 0.1, 0.2, 0.4 }, 100);
  const SceneObjects objects{ room.build(), {} };
  constexpr std::size_t kFirst = 2, kWalls = 64;
  std::vector<double> variance(2, 0.0);
  for (const bool gathers : { false, true })
  {
    SeedMeans means;
    for (std::uint64_t seed = 1; seed <= 16; ++seed)
    {
      EngineSettings settings = faintSettings(CellEstimate::Sums, 1, seed);
      settings.numberOfWalks = 8000;
      settings.gathersDirectLight = gathers;
      UpdatedEngine engine(objects, settings);
      means.add(engine);
    }
    for (std::size_t cell = kFirst; cell < kFirst + kWalls; ++cell)
    {
      variance[gathers ? 1 : 0] += std::pow(means.cells()[cell].standardError(), 2);
    }
  }
  EXPECT_LT(variance[1], 1.5 * variance[0]);
}

}
}
