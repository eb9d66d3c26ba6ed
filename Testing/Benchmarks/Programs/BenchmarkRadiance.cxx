// SPDX-License-Identifier: BSD-3-Clause
/**
 * What an eye costs where mirrors show glossy walls: a room of some 300 coarse cells, each of which
 * has a lobe or is a mirror. One thread, CPU time. Sums by side are counted once for all eyes. In a
 * furnace the radiance is known: the mean over the walls, all of which face the eye, is compared
 * before any time counts; the scatter of the cells is their error.
 *
 * Arguments: [walks = 500000] [rounds = 3] [samples = 64]
 */
#include "../../PhotonWalks/TestScenes.h"
#include "Measuring/EngineTiming.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Views/OutgoingRadiance.h"

#include <cmath>
#include <stdexcept>

using namespace irradiance;

namespace
{

test::Look glossy(double diffuse, double specular, double exponent, double exitance)
{
  test::Look look = test::grey(diffuse, exitance);
  look.specular = { specular, specular, specular };
  look.exponent = exponent;
  return look;
}

constexpr int kCells = 7, kCoarse = 3;                                      // along an edge
constexpr std::size_t kWallCells = 5 * kCells * kCells + kCoarse * kCoarse; // the first ones

/// Emits on each cell what it absorbs, so that the radiance is 1 / pi everywhere. One wall of 49
/// cells is a mirror; a box of 54 stands in the room.
SceneObjects makeFurnace(double exponent)
{
  test::ObjectBuilder room;
  const Box walls = test::box({ 0, 0, 0 }, { 4, 4, 3 });
  room.addSide(walls, 0, kCells, glossy(0, 0.7, kInfinity, 0.3), true);
  for (int side = 1; side < 6; ++side)
  {
    room.addSide(walls, side, side == 1 ? kCoarse : kCells, glossy(0.3, 0.4, exponent, 0.3), true);
  }
  room.addBox(test::box({ 2, 2, 1 }, { 2.5, 2.5, 1.5 }), 3, glossy(0.3, 0.4, exponent, 0.3));
  return { room.build(), {} };
}

}

void run(const Arguments& arguments)
{
  EngineSettings settings;
  settings.numberOfWalks = arguments.number(0, 500000u);
  settings.keepPhotons = true;
  const int rounds = arguments.number(1, 3);
  const auto samples = arguments.number(2, 64u);
  for (const double exponent : { 5.0, 50.0, 1000.0 })
  {
    const SceneObjects objects = makeFurnace(exponent);
    const std::string row = std::to_string(objects.staticObject.material->numberOfCells) +
      " cells, lobes of exponent " + std::to_string(static_cast<int>(exponent));
    std::vector<SceneCell> cells;
    for (std::size_t cell = 0; cell < objects.staticObject.material->numberOfCells; ++cell)
    {
      cells.push_back({ 0, cell });
    }
    IrradianceEngine engine;
    CpuTime execution;
    engine.update(objects, settings, execution);
    for (int round = 0; round < rounds; ++round)
    {
      std::unique_ptr<OutgoingRadiance> radiance;
      const double counted = threadCpuSecondsOf(
        [&] { radiance = std::make_unique<OutgoingRadiance>(engine, samples, execution); });
      std::vector<OutgoingRadiance::Light> seen;
      const double looked = threadCpuSecondsOf([&] {
        seen = radiance->at(cells, { { 3.2, 0.7 + 0.1 * round, 1.4 } });
      });
      double mean = 0, squares = 0;
      for (std::size_t cell = 0; cell < kWallCells; ++cell)
      {
        mean += M_PI * seen[cell].value[0] / kWallCells;
        squares += std::pow(M_PI * seen[cell].value[0] - 1, 2) / kWallCells;
      }
      if (!(std::abs(mean - 1) < 0.01))
      {
        throw std::runtime_error("The radiance of the furnace is off");
      }
      report("Radiance", row, "an eye, s", looked, { 1, 0.5 });
      report("Radiance", row, "error of a cell, %", 100 * std::sqrt(squares));
      report("Radiance", row, "sides counted, s", counted);
    }
  }
}
