// SPDX-License-Identifier: BSD-3-Clause
/**
 * Where the time goes, stage by stage: of the first shooting of the plain room, and of frames in
 * which a ring moves that changes some 2 % of the walks. The engine times its own stages as it runs
 * (Progress/StageTimes.h); their sum stands beside the whole, and beside the whole of a second
 * engine whose stages are not timed, which takes turns and has to have the same answer. One thread,
 * by the clock on the wall.
 *
 * Arguments: [walks = 1000000] [rounds = 5] [frames = 8]
 * [size of the ring, or of a mover, m = 0.73]
 * [movers, in place of the ring = 0]
 */
#include "Measuring/EngineTiming.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Measuring/TimedStages.h"
#include "Scenes/PlainRoom.h"

#include <numeric>
#include <stdexcept>

using namespace irradiance;

namespace
{

/// In the order of Stage.
constexpr const char* kNames[] = { "start", "pre-test of bodies", "prepare for a tree",
  "search in trees", "confirm in double", "sides", "receive", "absorb", "leave", "store",
  "scan of the history", "sort suspects", "rays of suspects", "remove old tails",
  "between bounces" };
static_assert(std::size(kNames) == kStages);

/// Nanoseconds of an update, by one clock.
struct Update
{
  StageTimes stages;
  double sum, whole, untimed; ///< `untimed`: the whole of the other engine
};

/// Two engines that follow the same scene.
class Pair
{
public:
  explicit Pair(const EngineSettings& settings)
    : settings_(settings)
  {
  }

  Update update(const SceneObjects& objects)
  {
    Update update{};
    {
      const TimedStages stages;
      update.whole = nanoseconds(timed_, objects);
      update.stages = stages.all();
    }
    update.untimed = nanoseconds(untimed_, objects);
    update.sum = std::accumulate(update.stages.begin(), update.stages.end(), 0.0);
    if (update.sum == 0)
    {
      throw std::runtime_error("The stages are timed if VTKIRRADIANCE_COUNT_QUERIES is on");
    }
    if (update.sum > update.whole)
    {
      throw std::runtime_error("Some time counts for two stages");
    }
    return update;
  }
  void check(const SceneObjects& objects) const { requireEqualAnswers(timed_, untimed_, objects); }

  const IrradianceEngine& engine() const { return timed_; }

private:
  double nanoseconds(IrradianceEngine& engine, const SceneObjects& objects) const
  {
    Execution alone;
    return 1e9 * timeUpdate(engine, objects, settings_, alone).whole;
  }

  EngineSettings settings_;
  IrradianceEngine timed_, untimed_;
};

/// In units of so many ns, and as shares. Stages that do not occur are left out.
void reportUpdate(const char* table, const Update& update, const char* unit, double nanoseconds)
{
  const auto add = [&](const char* row, double time) {
    report(table, row, unit, time / nanoseconds);
    report(table, row, "% of the whole", 100 * time / update.whole);
  };
  for (std::size_t stage = 0; stage < kStages; ++stage)
  {
    if (update.stages[stage] > 0)
    {
      add(kNames[stage], update.stages[stage]);
    }
  }
  add("all stages", update.sum);
  add("all else", update.whole - update.sum);
  add("the whole", update.whole);
  add("the whole, not timed by stages", update.untimed);
}

/// What a frame had to do.
void reportChanges(const IrradianceEngine& engine, double walks, double segments)
{
  const EngineStatistics& cost = engine.statistics();
  const auto share = [&](const char* what, std::int64_t some, double all) {
    report("StagesChanges", "frame", what, 100 * static_cast<double>(some) / all);
  };
  share("walks changed, %", cost.invalidWalks, walks);
  share("suspects, % of the segments", cost.suspectSegments, segments);
  share("shot again, % of the segments", cost.repairedSegments, segments);
}

}

void run(const Arguments& arguments)
{
  EngineSettings settings;
  settings.numberOfWalks = arguments.number(0, 1000000u);
  const int rounds = arguments.number(1, 5);
  const int frames = arguments.number(2, 8);
  const double size = arguments.number(3, 0.73);
  const int movers = arguments.number(4, 0);
  const MovingScene room = movers > 0 ? makeRoomOfMovers(movers, size) : makePlainRoom(size);
  Pair(settings).update(room.at(0)); // warms up
  for (int round = 0; round < rounds; ++round)
  {
    Pair pair(settings);
    const Update first = pair.update(room.at(0));
    const auto segments = static_cast<double>(pair.engine().balance().segments);
    reportUpdate("StagesShooting", first, "ns a segment", segments);
    for (int frame = 1; frame <= frames; ++frame)
    {
      reportUpdate("StagesFrame", pair.update(room.inFrame(frame)), "ms", 1e6);
      reportChanges(pair.engine(), settings.numberOfWalks, segments);
    }
    pair.check(room.inFrame(frames));
  }
}
