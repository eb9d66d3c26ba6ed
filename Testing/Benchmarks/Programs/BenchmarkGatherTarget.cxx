// SPDX-License-Identifier: BSD-3-Clause
/**
 * What a target takes where all cells gather: with rays that stay as many as they are (the first
 * 32), so that walks are doubled alone, and with both levers; in rooms of which each cell, or each
 * wall, has one reflectance. The time is that of a first frame, and of a frame in which the ring
 * has moved by 2 cm, which equals a fresh start. One thread, CPU time, in turns.
 *
 * Arguments: [walks = 100000] [most walks = 1600000] [rounds = 2] [rooms = 2]
 */
#include "Measuring/EngineTiming.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Rivals/EmbreeScene.h"
#include "Scenes/PlainRoom.h"

using namespace irradiance;

namespace
{

const std::string kTable = "GatherTarget";

EngineSettings gathering(std::uint32_t walks, std::uint32_t most)
{
  EngineSettings settings;
  settings.numberOfWalks = walks;
  settings.maximumNumberOfWalks = most;
  settings.replicates = 16;
  settings.gathersDirectLight = true;
  settings.cellEstimate = CellEstimate::Gathered;
  settings.gathersEverywhere = true;
  return settings;
}

void reach(const MovingScene& scene, const EngineSettings& settings, const std::string& row,
  const std::string& levers)
{
  IrradianceEngine engine;
  const auto add = [&](const std::string& what, double value) {
    report(kTable, row, levers + ": " + what, value);
  };
  add("first, s", timeUpdate(engine, scene.inFrame(0), settings).whole);
  add("walks", engine.numberOfWalks());
  add("rays", static_cast<double>(engine.numberOfGatherRays()));
  add("reached, %", 100 * engine.reachedRelativeError());
  add("frame, s", timeUpdate(engine, scene.inFrame(1), settings).whole);
}

void compare(const MovingScene& scene, EngineSettings settings, int rounds)
{
  constexpr std::uint32_t kMostRays = 4096;
  for (const int percent : { 10, 5, 3 })
  {
    const std::string row = scene.name + ", " + std::to_string(percent) + " %";
    settings.targetRelativeError = 0.01 * percent;
    for (int round = 0; round < rounds; ++round)
    {
      settings.seed = static_cast<std::uint64_t>(round) + 1;
      settings.maximumGatherRays = settings.gatherRays;
      reach(scene, settings, row, "walks");
      settings.maximumGatherRays = kMostRays;
      reach(scene, settings, row, "both");
    }
  }
}

}

void run(const Arguments& arguments)
{
  const auto walks = arguments.number(0, 100000u), most = arguments.number(1, 1600000u);
  const int rounds = arguments.number(2, 2);
  flushDenormals();
  const std::vector<MovingScene> rooms = makeGatheringRooms();
  for (std::size_t i = 0; i < std::min(rooms.size(), arguments.number(3, std::size_t{ 2 })); ++i)
  {
    compare(rooms[i], gathering(walks, most), rounds);
  }
}
