#include "ThreadContest.h"

#include "TwoThreads.h"

#include <chrono>

using namespace irradiance;

namespace
{

double wallSeconds(IrradianceEngine& engine, const SceneObjects& objects,
  const EngineSettings& settings, Execution& execution)
{
  const auto start = std::chrono::steady_clock::now();
  engine.update(objects, settings, execution);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}

ThreadSpeeds timeThreads(
  const MovingTeapotScene& scene, const EngineSettings& settings, int rounds, int frames)
{
  Execution one;
  TwoThreads two;
  ThreadSpeeds speeds;
  for (int round = 0; round < rounds; ++round)
  {
    IrradianceEngine alone, together;
    for (int frame = 0; frame <= frames; ++frame)
    {
      const SceneObjects objects = scene.objectsAt(frame * MovingTeapotScene::kFrame);
      const double slow = wallSeconds(alone, objects, settings, one);
      const double fast = wallSeconds(together, objects, settings, two);
      (frame == 0 ? speeds.shooting : speeds.frame).push_back(slow / fast);
    }
  }
  return speeds;
}
