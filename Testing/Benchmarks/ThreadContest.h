#ifndef ThreadContest_h
#define ThreadContest_h

#include "IrradianceEngine.h"
#include "MovingTeapotScene.h"

#include <vector>

/// Speed of two threads with that of one as the unit, by the clock on the wall.
struct ThreadSpeeds
{
  std::vector<double> shooting; ///< one for each round
  std::vector<double> frame;    ///< one for each frame of each round
};

/// The same updates with one thread and with two, in turns. Needs two processors that nobody else
/// uses.
ThreadSpeeds timeThreads(const MovingTeapotScene& scene, const irradiance::EngineSettings& settings,
  int rounds, int frames);

#endif
