#ifndef CacheContest_h
#define CacheContest_h

#include "IrradianceEngine.h"
#include "MovingTeapotScene.h"

#include <vector>

/// Section 3.3 of the paper: time of repair with the cache of static hits, as a part of that without,
/// for each of some frames. The teapot swings to and fro, so that what it hides in one frame it sets
/// free in another. Throws std::runtime_error when the cache changes a sum.
std::vector<double> timeCache(
  const MovingTeapotScene& scene, const irradiance::EngineSettings& settings, int frames);

#endif
