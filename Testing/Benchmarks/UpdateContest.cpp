#include "UpdateContest.h"

#include "Spread.h"
#include "Timing.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <stdexcept>
#include <string>

using namespace irradiance;

namespace
{

/// Power received by an object, as a part of that received by all.
double shareOf(const CellSums& sums, const SceneObjects& objects, std::uint32_t object)
{
  double own = 0, all = 0;
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    for (std::size_t cell = 0; cell < objects[i].material->numberOfCells; ++cell)
    {
      const auto power = static_cast<double>(sums.sum(i, cell, 0, 0));
      all += power;
      own += i == object ? power : 0.0;
    }
  }
  return own / all;
}

void compareAnswers(const IrradianceEngine& engine, const SceneObjects& objects,
  std::int64_t segments, const CellSums& sums)
{
  const double ours = shareOf(engine.sums(), objects, MovingTeapotScene::kTeapot);
  const double theirs = shareOf(sums, objects, MovingTeapotScene::kTeapot);
  const std::int64_t counted = engine.balance().segments;
  if (std::abs(static_cast<double>(segments) / static_cast<double>(counted) - 1) > 2e-3 ||
    std::abs(ours / theirs - 1) > 2e-2)
  {
    throw std::runtime_error("The answers differ: " + std::to_string(counted) + " and " +
      std::to_string(segments) + " segments, teapot's share " + std::to_string(ours) + " and " +
      std::to_string(theirs));
  }
}

double timeUnchanged(
  IrradianceEngine& engine, const SceneObjects& objects, const EngineSettings& settings)
{
  Execution serial;
  std::vector<double> seconds;
  for (int repetition = 0; repetition < 20; ++repetition)
  {
    const double start = threadCpuSeconds();
    engine.update(objects, settings, serial);
    seconds.push_back(threadCpuSeconds() - start);
  }
  return spreadOf(seconds).median;
}

void print(const UpdateTimes& times, std::int64_t segments)
{
  const double nanoseconds = 1e9 / static_cast<double>(segments);
  std::printf(
    "shooting %.3f s, %.0f ns a segment; Embree", times.shooting, nanoseconds * times.shooting);
  for (const auto& [form, seconds] : times.embree)
  {
    std::printf(", %s %.0f ns", nameOf(form), nanoseconds * seconds);
  }
  std::printf("; a frame changes %.2f %% of the walks\n", 100 * spreadOf(times.changed).median);
  std::fflush(stdout);
}

}

PhaseTimes timeUpdate(
  IrradianceEngine& engine, const SceneObjects& objects, const EngineSettings& settings)
{
  Execution serial;
  const double start = threadCpuSeconds();
  engine.update(objects, settings, serial);
  const double whole = threadCpuSeconds() - start;
  const EngineStatistics& cost = engine.statistics();
  const double verifying = whole * cost.verifySeconds / (cost.verifySeconds + cost.repairSeconds);
  return { verifying, whole - verifying };
}

UpdateTimes timeUpdates(const MovingTeapotScene& scene, const EngineSettings& settings, int frames)
{
  Execution serial;
  UpdateTimes times;
  const SceneObjects objects = scene.objectsAt(0);
  IrradianceEngine engine;
  const double start = threadCpuSeconds();
  engine.update(objects, settings, serial);
  times.shooting = threadCpuSeconds() - start;
  const std::int64_t segments = engine.balance().segments;
  times.bytesPerHit =
    static_cast<double>(engine.statistics().historyBytes) / static_cast<double>(segments);

  const EmbreeScene embree(objects);
  for (const EmbreeForm form : kEmbreeForms)
  {
    CellSums sums(objects, 1);
    const double begin = threadCpuSeconds();
    const std::int64_t count =
      shootWithEmbree(form, embree, objects, settings.numberOfWalks, settings.seed, sums);
    times.embree[form] = threadCpuSeconds() - begin;
    compareAnswers(engine, objects, count, sums);
  }
  times.unchanged = timeUnchanged(engine, objects, settings);

  for (int frame = 1; frame <= frames; ++frame)
  {
    const PhaseTimes update =
      timeUpdate(engine, scene.objectsAt(frame * MovingTeapotScene::kFrame), settings);
    times.verifying.push_back(update.verifying);
    times.repairing.push_back(update.repairing);
    times.changed.push_back(static_cast<double>(engine.statistics().invalidWalks) /
      static_cast<double>(settings.numberOfWalks));
  }
  print(times, segments);
  return times;
}

EmbreeForm fastestForm(const std::vector<UpdateTimes>& rounds)
{
  const auto median = [&](EmbreeForm form) {
    std::vector<double> seconds;
    std::transform(rounds.begin(), rounds.end(), std::back_inserter(seconds),
      [form](const UpdateTimes& round) { return round.embree.at(form); });
    return spreadOf(seconds).median;
  };
  return *std::min_element(std::begin(kEmbreeForms), std::end(kEmbreeForms),
    [&](EmbreeForm a, EmbreeForm b) { return median(a) < median(b); });
}
