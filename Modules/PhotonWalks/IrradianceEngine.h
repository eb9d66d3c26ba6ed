#ifndef irradiance_IrradianceEngine_h
#define irradiance_IrradianceEngine_h

#include "Execution.h"
#include "PowerBalance.h"
#include "Surface.h"
#include "WalkVerifier.h"

#include <chrono>

namespace irradiance
{

struct EngineSettings
{
  std::uint32_t numberOfWalks = 1000000;
  std::uint64_t seed = 1;
  TraversalMode traversalMode = TraversalMode::Parallel;
  bool verify = true; ///< false: every frame is shot anew
  bool cacheStaticHits = true;
  bool separateSides = false;
};

/// What a frame cost.
struct EngineStatistics
{
  std::int64_t invalidWalks = 0; ///< found by the verification
  std::int64_t repairedSegments = 0;
  double shootSeconds = 0;
  double verifySeconds = 0; ///< with the rebuilding of the trees over moving objects
  double repairSeconds = 0;
  std::size_t historyBytes = 0;
};

/**
 * The front door of the engine: a scene in, the power received by every cell out.
 *
 * The first frame is shot. Later ones are verified and repaired where only dynamic objects changed
 * pose or points; the sums are then equal, bit for bit, to those of a new engine. Anything else (a
 * change of lights, reflectances, static geometry, settings, the number of objects) is shot anew.
 */
class IrradianceEngine
{
public:
  /// All objects need a body and a surface, with the same number of bands.
  void update(const SceneObjects& objects, const EngineSettings& settings, Execution& execution);

  /// W/m2 received by `side` (0 front or both, 1 back) of a cell, given its area; 0 if that is 0.
  double irradiance(std::uint32_t object, std::size_t cell, int side, int band, double area) const;
  /// Watts of a number of quanta.
  double watts(std::int64_t quanta) const
  {
    return static_cast<double>(quanta) * emitters_.quantum();
  }
  bool hasEmitters() const { return !emitters_.isEmpty(); }
  const PowerBalance& balance() const { return balance_; }
  const EngineStatistics& statistics() const { return statistics_; }
  const CellSums& sums() const { return sums_; }

private:
  using Clock = std::chrono::steady_clock;
  struct BatchPass;

  /// Cheap; false is no proof that they changed.
  bool doLightsStand(const SceneObjects& objects, const EngineSettings& settings) const;
  /// With the same lights.
  bool canRepair(const SceneObjects& objects, const EngineSettings& settings) const;
  std::vector<bool> findMoved(const SceneObjects& objects) const;
  void commitScene(const std::vector<bool>& moved, Execution& execution);
  void shootAll(Execution& execution);
  void verifyAndRepair(const std::vector<bool>& moved, Execution& execution);
  std::vector<std::vector<StaleSegment>> verify(
    const WalkShooter& shooter, const std::vector<bool>& moved, Execution& execution);
  void repair(const WalkShooter& shooter, const std::vector<std::vector<StaleSegment>>& stale,
    Execution& execution);
  void run(const BatchPass& pass, const WalkShooter& shooter, Execution& execution);
  /// Walks are inside, but for escapes.
  Box walkBounds() const;
  double reachInFrame() const;
  void cacheStaticHit(WalkBlock& block, const StaleSegment& stale) const;
  std::size_t numberOfBlocks() const;
  std::uint32_t walksIn(std::size_t block) const;

  bool isValid_ = false; ///< the state below belongs to objects_ and settings_
  SceneObjects objects_;
  EngineSettings settings_;
  Scene scene_;
  EmitterTable emitters_;
  CellSums sums_;
  PowerBalance balance_;
  std::vector<WalkBlock> history_; ///< empty unless something may move
  UnitFrame pointFrame_;           ///< of the stored points
  double pointReach_ = 0;          ///< their largest coordinate, but for those of escapes
  double clearance_ = 0;           ///< of all frames since the walks were shot, see Scene
  EngineStatistics statistics_;
};

}

#endif
