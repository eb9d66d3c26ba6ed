#ifndef UpdateContest_h
#define UpdateContest_h

#include "EmbreeShooter.h"
#include "IrradianceEngine.h"
#include "MovingTeapotScene.h"

#include <map>
#include <vector>

/// What a round of updates costs, in seconds of this thread's CPU time.
struct UpdateTimes
{
  double shooting;                     ///< the first frame of a new engine
  std::map<EmbreeForm, double> embree; ///< for the same walks
  std::vector<double> verifying;       ///< for each further frame
  std::vector<double> repairing;
  std::vector<double> changed; ///< share of the walks
  double unchanged;            ///< an update with the input of the frame before, median of 20
  double bytesPerHit;
};

/// Shoots the first frame with a new engine and in all forms with Embree, compares the answers, then
/// lets the teapot go on. Throws std::runtime_error when the answers differ.
UpdateTimes timeUpdates(
  const MovingTeapotScene& scene, const irradiance::EngineSettings& settings, int frames);

/// The form with the smallest median.
EmbreeForm fastestForm(const std::vector<UpdateTimes>& rounds);

/// Seconds of this thread for an update that is verified and repaired, by phases. The engine's own
/// clocks run on while the machine does other things; only their ratio is used.
struct PhaseTimes
{
  double verifying, repairing;
};
PhaseTimes timeUpdate(irradiance::IrradianceEngine& engine, const irradiance::SceneObjects& objects,
  const irradiance::EngineSettings& settings);

#endif
