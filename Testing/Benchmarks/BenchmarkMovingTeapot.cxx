/**
 * The bars of the main job on the scene of Examples/MovingTeapot, one thread: how shooting compares
 * with a loop of Embree's rtcIntersect1 that does the same walks, and what a frame costs beside the
 * first shooting. The answers are compared before any time counts; the two are timed in turns in
 * one process by the thread's CPU time, and the medians of the ratios are given.
 *
 * Arguments: [walks = 1000000] [rounds = 5] [frames = 10] [head.off]
 */
#include "EmbreeShooter.h"
#include "Goals.h"
#include "IrradianceEngine.h"
#include "Results.h"
#include "SceneReader.h"
#include "TeapotPath.h"
#include "TeapotScene.h"
#include "Timing.h"

#include <vtkCellData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkTransform.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

using namespace irradiance;

namespace
{

AffineMap poseAt(double time)
{
  static movingteapot::TeapotPath path;
  vtkNew<vtkTransform> transform;
  path.SetPose(time, transform);
  const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> matrix(
    transform->GetMatrix()->GetData());
  return { matrix.topLeftCorner<3, 3>(), matrix.topRightCorner<3, 1>() };
}

SceneObjects makeScene(const std::string& head)
{
  movingteapot::SceneConfig config;
  config.HeadFile = head;
  const movingteapot::TeapotScene scene = movingteapot::MakeTeapotScene(config);
  const auto connect = [](vtkPolyData* part) {
    vtkCellData* cells = part->GetCellData();
    return InputConnection{ "part of the scene", part, cells->GetAbstractArray("RadiantExitance"),
      cells->GetAbstractArray("DiffuseReflectance"), nullptr };
  };
  std::vector<InputConnection> fixed;
  for (vtkPolyData* part :
    { scene.Room.Get(), scene.Lamp.Get(), scene.Plinth.Get(), scene.Head.Get() })
  {
    if (part)
    {
      fixed.push_back(connect(part));
    }
  }
  SceneReader reader;
  reader.read(fixed, { connect(scene.Teapot) }, { poseAt(0) }, 0.5, {});
  return reader.objects();
}

/// Power received by an object, as a part of that received by all.
double shareOf(const CellSums& sums, const SceneObjects& objects, std::uint32_t object)
{
  double own = 0, all = 0;
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    for (std::size_t cell = 0; cell < objects[i].surface->numberOfCells; ++cell)
    {
      const auto power = static_cast<double>(sums.sum(i, cell, 0, 0));
      all += power;
      own += i == object ? power : 0.0;
    }
  }
  return own / all;
}

struct Timings
{
  std::vector<double> shootOverEmbree, verifyOverShoot, repairOverShoot, frameOverShoot,
    verifyOverEmbree, embreeOverFrame, invalid;
};

void timeRound(SceneObjects objects, const EngineSettings& settings, int frames, Timings& timings)
{
  Execution serial;
  IrradianceEngine engine;
  double start = threadCpuSeconds();
  engine.update(objects, settings, serial);
  const double shooting = threadCpuSeconds() - start;

  const EmbreeScene embree(objects);
  CellSums sums(objects, 1);
  start = threadCpuSeconds();
  const std::int64_t segments =
    shootWithEmbree(embree, objects, settings.numberOfWalks, settings.seed, sums);
  const double peer = threadCpuSeconds() - start;

  const double ours = shareOf(engine.sums(), objects, 1), theirs = shareOf(sums, objects, 1);
  const auto counted = static_cast<double>(engine.balance().segments);
  if (std::abs(static_cast<double>(segments) / counted - 1) > 2e-3 ||
    std::abs(ours / theirs - 1) > 2e-2)
  {
    std::fprintf(stderr, "The answers differ: %lld and %lld segments, teapot's share %g and %g\n",
      static_cast<long long>(engine.balance().segments), static_cast<long long>(segments), ours,
      theirs);
    std::exit(EXIT_FAILURE);
  }
  timings.shootOverEmbree.push_back(shooting / peer);
  std::printf("shooting %.3f s, Embree %.3f s, %.0f ns and %.0f ns a segment, %.1f bytes a hit\n",
    shooting, peer, 1e9 * shooting / counted, 1e9 * peer / counted,
    static_cast<double>(engine.statistics().historyBytes) / counted);

  for (int frame = 1; frame <= frames; ++frame)
  {
    objects.dynamic[0].worldFromObject = poseAt(frame / 60.0);
    start = threadCpuSeconds();
    engine.update(objects, settings, serial);
    const double whole = threadCpuSeconds() - start;
    const EngineStatistics& cost = engine.statistics();
    // The engine's own clocks run on while the machine does other things; only their ratio counts.
    const double verifying = whole * cost.verifySeconds / (cost.verifySeconds + cost.repairSeconds);
    timings.verifyOverShoot.push_back(verifying / shooting);
    timings.repairOverShoot.push_back((whole - verifying) / shooting);
    timings.frameOverShoot.push_back(whole / shooting);
    timings.verifyOverEmbree.push_back(verifying / peer);
    timings.embreeOverFrame.push_back(peer / whole);
    timings.invalid.push_back(
      static_cast<double>(cost.invalidWalks) / static_cast<double>(settings.numberOfWalks));
  }
}

void report(const Timings& timings)
{
  Results results("BenchmarkMovingTeapot");
  const auto add = [&](const char* row, const char* quantity, const std::vector<double>& values,
                     const Goal& goal = {}) {
    results.add("MovingTeapot", row, quantity, values, goal);
  };
  const char* const overShooting = "time / first shooting";
  const char* const overEmbree = "time / the same walks with rtcIntersect1";
  add("first shooting", overEmbree, timings.shootOverEmbree);
  add("verification (paper: 0.14)", overShooting, timings.verifyOverShoot);
  add("repair (paper: 0.029)", overShooting, timings.repairOverShoot);
  add("verification and repair (paper: 0.17)", overShooting, timings.frameOverShoot);
  add("verification", overEmbree, timings.verifyOverEmbree, goals::kVerification);
  add("re-shooting with rtcIntersect1", "time / verification and repair", timings.embreeOverFrame,
    goals::kReshooting);
  add("walks that changed in a frame", "share of all walks", timings.invalid);
  results.finish();
}

}

int main(int argc, char* argv[])
{
  EngineSettings settings;
  settings.numberOfWalks =
    argc > 1 ? static_cast<std::uint32_t>(std::strtoul(argv[1], nullptr, 10)) : 1000000;
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 5;
  const int frames = argc > 3 ? std::atoi(argv[3]) : 10;
  const SceneObjects objects = makeScene(argc > 4 ? argv[4] : VTKIRRADIANCE_HEAD);
  std::printf("%zu static and %zu dynamic triangles, %u walks, %d rounds, %d frames\n",
    objects.fixed.body->mesh().size(), objects.dynamic[0].body->mesh().size(),
    settings.numberOfWalks, rounds, frames);
  Timings timings;
  for (int round = 0; round < rounds; ++round)
  {
    timeRound(objects, settings, frames, timings);
  }
  report(timings);
  return EXIT_SUCCESS;
}
