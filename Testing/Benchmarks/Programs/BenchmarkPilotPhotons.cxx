// SPDX-License-Identifier: BSD-3-Clause
/**
 * Verification, which finds every walk that changed, beside pilot photons, which find some of them:
 * what a frame costs, and what is wrong after it. Both go through the same frames with the same
 * walks; what is right is what a fresh start gives, with which the engine has to agree to the bit.
 * A frame's time is the CPU time of the one thread, divided by the time of shooting all walks
 * again.
 *
 * Arguments: [walks = 262144] [frames = 4] [head.off]
 */
#include "Measuring/CellField.h"
#include "Measuring/EngineTiming.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Rivals/PilotTracer.h"

#include <limits>
#include <numeric>
#include <stdexcept>

using namespace irradiance;

namespace
{

constexpr std::uint64_t kSeed = 1;
constexpr double kUnlimited = std::numeric_limits<double>::infinity(); // s

struct Frame
{
  Truth truth;
  std::vector<std::uint64_t> signatures; ///< of the right walks
};

CellField receivedBy(const PilotTracer& tracer, const SceneObjects& objects)
{
  return fieldOf(objects, [&](std::uint32_t object, std::size_t cell, double area) {
    return tracer.watts(tracer.sums().sum({ object, cell }, 0)) / area;
  });
}

std::vector<Frame> framesOf(const TradeScene& scene, PilotTracer& fresh, int count)
{
  std::vector<Frame> frames;
  for (int frame = 0; frame <= count; ++frame)
  {
    const SceneObjects objects = scene.at(0.4 + frame * MovingScene::kFrame);
    fresh.shootAll(objects);
    frames.push_back({ { objects, receivedBy(fresh, objects) }, fresh.signatures() });
  }
  return frames;
}

double staleOf(const PilotTracer& tracer, const Frame& frame)
{
  const std::vector<std::uint64_t> walks = tracer.signatures();
  return static_cast<double>(walks.size()) -
    std::inner_product(
      walks.begin(), walks.end(), frame.signatures.begin(), 0.0, std::plus<>(), std::equal_to<>());
}

/// One who follows a scene for a frame: what it cost and what it leaves.
struct Outcome
{
  double seconds, shot, missed; ///< walks shot, changed walks missed: %
  CellField irradiance;
};

void reportFrame(
  const std::string& row, const Outcome& outcome, const Truth& truth, PilotTracer& fresh)
{
  // Right after what is compared with it: the machine is not as fast at all times.
  const double start = threadCpuSeconds();
  fresh.shootAll(truth.objects);
  const double anew = threadCpuSeconds() - start;
  const auto reportValue = [&](const char* quantity, double value) {
    report("PilotPhotons", row, quantity, value);
  };
  reportValue("time / all anew", outcome.seconds / anew);
  reportValue("walks shot, %", outcome.shot);
  reportValue("changed walks missed, %", outcome.missed);
  reportValue("RMS error", truth.rmsError(outcome.irradiance));
  reportValue("largest error",
    (outcome.irradiance - truth.irradiance).abs().maxCoeff() /
      meanOf(truth.irradiance, truth.areas));
}

/// Returns its time for each frame, s.
std::vector<double> measureVerification(
  const TradeScene& scene, const std::vector<Frame>& frames, PilotTracer& fresh)
{
  EngineSettings settings;
  settings.numberOfWalks = static_cast<std::uint32_t>(frames[0].signatures.size());
  settings.seed = kSeed;
  IrradianceEngine engine;
  timeUpdate(engine, frames[0].truth.objects, settings);
  std::vector<double> times;
  for (std::size_t frame = 1; frame < frames.size(); ++frame)
  {
    const Truth& truth = frames[frame].truth;
    times.push_back(timeUpdate(engine, truth.objects, settings).whole);
    const CellField irradiance = irradianceOf(engine, truth.objects);
    truth.require(irradiance, scene.name + ": verification");
    const double shot =
      100 * static_cast<double>(engine.statistics().invalidWalks) / settings.numberOfWalks;
    reportFrame(scene.name + ", verification, all are found", { times.back(), shot, 0, irradiance },
      truth, fresh);
  }
  return times;
}

/// `pilots`: share of the walks. `seconds`: for each frame.
void measurePilots(const TradeScene& scene, const std::vector<Frame>& frames, double pilots,
  const std::vector<double>& seconds, const std::string& row, PilotTracer& fresh)
{
  const std::size_t walks = frames[0].signatures.size();
  PilotTracer tracer(
    frames[0].truth.objects, static_cast<std::uint32_t>(walks), kSeed, scene.strata);
  for (std::size_t frame = 1; frame < frames.size(); ++frame)
  {
    const Truth& truth = frames[frame].truth;
    const double before = staleOf(tracer, frames[frame]);
    const double start = threadCpuSeconds();
    const std::size_t shot = tracer.update(truth.objects, pilots, seconds[frame - 1]);
    const double time = threadCpuSeconds() - start;
    const double missed = before == 0 ? 0 : 100 * staleOf(tracer, frames[frame]) / before;
    reportFrame(scene.name + ", " + row,
      { time, 100 * static_cast<double>(shot) / static_cast<double>(walks), missed,
        receivedBy(tracer, truth.objects) },
      truth, fresh);
  }
}

/// Where all walks are pilots, none is missed.
void checkPilots(const TradeScene& scene, const std::vector<Frame>& frames)
{
  PilotTracer tracer(frames[0].truth.objects,
    static_cast<std::uint32_t>(frames[0].signatures.size()), kSeed, scene.strata);
  tracer.update(frames[1].truth.objects, 1, kUnlimited);
  frames[1].truth.require(
    receivedBy(tracer, frames[1].truth.objects), scene.name + ": pilots alone");
  if (staleOf(tracer, frames[1]) > 0)
  {
    throw std::runtime_error(scene.name + ": pilots alone miss walks");
  }
}

}

void run(const Arguments& arguments)
{
  const auto walks = arguments.number(0, 1u << 18);
  const int count = arguments.number(1, 4);
  for (const TradeScene& scene : makeTradeScenes(arguments.text(2, VTKIRRADIANCE_HEAD)))
  {
    report("PilotGroups", scene.name, "groups", scene.strata.numberOfGroups());
    PilotTracer fresh(scene.at(0.4), walks, kSeed, scene.strata);
    const std::vector<Frame> frames = framesOf(scene, fresh, count);
    checkPilots(scene, frames);
    const std::vector<double> seconds = measureVerification(scene, frames, fresh);
    const std::vector<double> unlimited(frames.size(), kUnlimited);
    for (const int part : { 64, 32, 16, 8, 4, 2 })
    {
      const std::string row = "pilots, 1/" + std::to_string(part);
      measurePilots(scene, frames, 1.0 / part, unlimited, row, fresh);
    }
    measurePilots(
      scene, frames, 1.0 / 64, seconds, "pilots in the time of verification, 1/64", fresh);
  }
}
