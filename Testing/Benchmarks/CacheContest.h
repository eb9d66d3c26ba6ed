#ifndef CacheContest_h
#define CacheContest_h

#include "IrradianceEngine.h"
#include "MovingTeapotScene.h"

#include <vector>

/// Times with the cache of static hits (section 3.3 of the paper) as a part of those without, for
/// each of some frames.
struct CacheGain
{
  std::vector<double> repair, verification, frame;
};

/// The teapot swings to and fro, so that what it hides in one frame it sets free in another. Throws
/// std::runtime_error when the cache changes a sum.
CacheGain timeCache(
  const MovingTeapotScene& scene, const irradiance::EngineSettings& settings, int frames);

#endif
