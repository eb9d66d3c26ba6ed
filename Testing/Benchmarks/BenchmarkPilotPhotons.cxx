/**
 * Verification, which finds every walk that changed, beside pilot photons, which find some of them:
 * what a frame costs, and what is wrong after it. Both go through the same frames with the same walks;
 * what is right is what a fresh start gives, with which the engine has to agree to the bit. A frame's
 * time is the CPU time of the one thread, divided by that of shooting all walks anew.
 *
 * Arguments: [walks = 262144] [frames = 4] [head.off]
 */
#include "CellField.h"
#include "PilotTracer.h"
#include "Program.h"
#include "Results.h"
#include "Timing.h"

#include <cstdlib>
#include <stdexcept>

using namespace irradiance;

namespace
{

const char* const kTable = "PilotPhotons";
constexpr std::uint64_t kSeed = 1;
constexpr double kFirst = 0.4;     ///< where the motion begins
constexpr double kStep = 1 / 60.0; ///< of time from frame to frame

/// What is right in a frame.
struct Truth
{
  SceneObjects objects;
  std::vector<std::uint64_t> signatures;
  CellField irradiance;
};

CellField fieldOf(const PilotTracer& tracer, const SceneObjects& objects)
{
  CellField field;
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    const std::vector<double> areas = cellAreas(objects[object]);
    for (std::size_t cell = 0; cell < areas.size(); ++cell)
    {
      field.push_back(tracer.watts(tracer.sums().sum(object, cell, 0, 0)) / areas[cell]);
    }
  }
  return field;
}

std::vector<Truth> truthsOf(const TradeScene& scene, PilotTracer& fresh, int frames)
{
  std::vector<Truth> truths;
  for (int frame = 0; frame <= frames; ++frame)
  {
    const SceneObjects objects = scene.at(kFirst + frame * kStep);
    fresh.shootAll(objects);
    truths.push_back({ objects, fresh.signatures(), fieldOf(fresh, objects) });
  }
  return truths;
}

std::size_t staleOf(const std::vector<std::uint64_t>& walks, const Truth& truth)
{
  std::size_t stale = 0;
  for (std::size_t i = 0; i < walks.size(); ++i)
  {
    stale += walks[i] != truth.signatures[i] ? 1 : 0;
  }
  return stale;
}

/// Values for each frame.
struct Figures
{
  std::vector<double> time, shot, missed, rms, worst;

  void give(const std::string& row, Results& results) const
  {
    results.add(kTable, row, "time / all anew", time);
    results.add(kTable, row, "walks shot, %", shot);
    results.add(kTable, row, "changed walks missed, %", missed);
    results.add(kTable, row, "RMS error", rms);
    results.add(kTable, row, "largest error", worst);
  }
};

void addErrors(const CellField& field, const Truth& truth, Figures& figures)
{
  const CellField areas = areasOf(truth.objects);
  figures.rms.push_back(rmsError(field, truth.irradiance, areas));
  figures.worst.push_back(worstError(field, truth.irradiance, areas));
}

/// Right after what is compared with it: the machine is not as fast at all times.
double secondsToShoot(PilotTracer& tracer, const Truth& truth)
{
  const double start = threadCpuSeconds();
  tracer.shootAll(truth.objects);
  return threadCpuSeconds() - start;
}

/// Returns its time for each frame, s.
std::vector<double> measureVerification(const TradeScene& scene, std::uint32_t walks,
  const std::vector<Truth>& truths, PilotTracer& fresh, Results& results)
{
  EngineSettings settings;
  settings.numberOfWalks = walks;
  settings.seed = kSeed;
  IrradianceEngine engine;
  Execution serial;
  engine.update(truths[0].objects, settings, serial);
  Figures figures;
  std::vector<double> times;
  for (std::size_t frame = 1; frame < truths.size(); ++frame)
  {
    const Truth& truth = truths[frame];
    const double start = threadCpuSeconds();
    engine.update(truth.objects, settings, serial);
    times.push_back(threadCpuSeconds() - start);
    if (irradianceOf(engine, truth.objects) != truth.irradiance)
    {
      throw std::runtime_error(scene.name + ": verification and a fresh start differ");
    }
    figures.time.push_back(times.back() / secondsToShoot(fresh, truth));
    figures.shot.push_back(100 * double(engine.statistics().invalidWalks) / walks);
    figures.missed.push_back(0); // the same bits
    addErrors(irradianceOf(engine, truth.objects), truth, figures);
  }
  figures.give(scene.name + ", verification, all are found", results);
  return times;
}

/// `seconds`: for each frame, or nothing for no limit.
void measurePilots(const TradeScene& scene, const std::vector<Truth>& truths, double pilots,
  const std::vector<double>& seconds, const std::string& row, PilotTracer& fresh, Results& results)
{
  const auto walks = truths[0].signatures.size();
  PilotTracer tracer(truths[0].objects, static_cast<std::uint32_t>(walks), kSeed, scene.strata);
  Figures figures;
  for (std::size_t frame = 1; frame < truths.size(); ++frame)
  {
    const Truth& truth = truths[frame];
    const std::size_t before = staleOf(tracer.signatures(), truth);
    PilotTracer::Effort effort{ pilots };
    if (!seconds.empty())
    {
      effort.seconds = seconds[frame - 1];
    }
    const double start = threadCpuSeconds();
    const std::size_t shot = tracer.update(truth.objects, effort);
    const double time = threadCpuSeconds() - start;
    figures.time.push_back(time / secondsToShoot(fresh, truth));
    figures.shot.push_back(100 * double(shot) / double(walks));
    const std::size_t after = staleOf(tracer.signatures(), truth);
    figures.missed.push_back(before == 0 ? 0 : 100 * double(after) / double(before));
    addErrors(fieldOf(tracer, truth.objects), truth, figures);
  }
  figures.give(scene.name + ", " + row, results);
}

/// Where all walks are pilots, none is missed.
void checkPilots(const TradeScene& scene, const std::vector<Truth>& truths)
{
  PilotTracer tracer(truths[0].objects, static_cast<std::uint32_t>(truths[0].signatures.size()),
    kSeed, scene.strata);
  tracer.update(truths[1].objects, { 1 });
  if (staleOf(tracer.signatures(), truths[1]) > 0 ||
    fieldOf(tracer, truths[1].objects) != truths[1].irradiance)
  {
    throw std::runtime_error(scene.name + ": pilots alone and a fresh start differ");
  }
}

void run(int argc, char* argv[])
{
  const auto walks =
    argc > 1 ? static_cast<std::uint32_t>(std::strtoul(argv[1], nullptr, 10)) : 1u << 18;
  const int frames = argc > 2 ? std::atoi(argv[2]) : 4;
  Results results("BenchmarkPilotPhotons");
  for (const TradeScene& scene : makeTradeScenes(argc > 3 ? argv[3] : VTKIRRADIANCE_HEAD))
  {
    results.add("PilotGroups", scene.name, "groups", { double(scene.strata.numberOfGroups()) });
    PilotTracer fresh(scene.at(kFirst), walks, kSeed, scene.strata);
    const std::vector<Truth> truths = truthsOf(scene, fresh, frames);
    checkPilots(scene, truths);
    const std::vector<double> seconds = measureVerification(scene, walks, truths, fresh, results);
    for (const int part : { 64, 32, 16, 8, 4, 2 })
    {
      measurePilots(
        scene, truths, 1.0 / part, {}, "pilots, 1/" + std::to_string(part), fresh, results);
    }
    measurePilots(
      scene, truths, 1.0 / 64, seconds, "pilots in the time of verification, 1/64", fresh, results);
  }
  results.finish();
}

}

int main(int argc, char* argv[])
{
  return runProgram(run, argc, argv);
}
