#include "CacheContest.h"

#include "UpdateContest.h"

#include <cstdlib>
#include <stdexcept>

using namespace irradiance;

namespace
{

/// Frames of a swing in one direction.
constexpr int kSwing = 5;

/// Over the head and back, with the same step in every frame.
double timeOfSwing(int frame)
{
  constexpr double kStart = 0.4;
  const int phase = frame % (2 * kSwing);
  return kStart + MovingTeapotScene::kFrame * (kSwing - std::abs(kSwing - phase));
}

void compareSums(const IrradianceEngine& a, const IrradianceEngine& b, const SceneObjects& objects)
{
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    for (std::size_t cell = 0; cell < objects[i].material->numberOfCells; ++cell)
    {
      if (a.sums().sum(i, cell, 0, 0) != b.sums().sum(i, cell, 0, 0))
      {
        throw std::runtime_error("The cache of static hits changes a sum");
      }
    }
  }
}

}

CacheGain timeCache(const MovingTeapotScene& scene, const EngineSettings& settings, int frames)
{
  EngineSettings with = settings, without = settings;
  with.cacheStaticHits = true;
  without.cacheStaticHits = false;
  IrradianceEngine engine, plain;
  Execution serial;
  engine.update(scene.objectsAt(timeOfSwing(0)), with, serial);
  plain.update(scene.objectsAt(timeOfSwing(0)), without, serial);
  CacheGain gain;
  constexpr int kFill = 2 * kSwing; // the cache begins empty
  for (int frame = 1; frame <= kFill + frames; ++frame)
  {
    const SceneObjects objects = scene.objectsAt(timeOfSwing(frame));
    const PhaseTimes cached = timeUpdate(engine, objects, with);
    const PhaseTimes uncached = timeUpdate(plain, objects, without);
    if (frame > kFill)
    {
      gain.repair.push_back(cached.repairing / uncached.repairing);
      gain.verification.push_back(cached.verifying / uncached.verifying);
      gain.frame.push_back(
        (cached.verifying + cached.repairing) / (uncached.verifying + uncached.repairing));
    }
    compareSums(engine, plain, objects);
  }
  return gain;
}
