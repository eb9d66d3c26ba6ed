#ifndef irradiance_WalkShooter_h
#define irradiance_WalkShooter_h

#include "Emitter.h"
#include "Scene.h"
#include "WalkHistory.h"

namespace irradiance
{

/// Starts and continues walks. A walk is a pure function of the scene, the samples and its number.
class WalkShooter
{
public:
  /// The arguments must outlive the shooter.
  WalkShooter(const Scene& scene, const SceneObjects& objects, const EmitterTable& emitters,
    const SobolSequence& samples)
    : scene_(scene)
    , objects_(objects)
    , emitters_(emitters)
    , samples_(samples)
  {
  }

  /// Shoots a whole walk into `trace`.
  void shoot(std::uint32_t walk, WalkTrace& trace) const;

  /// Shoots a walk from segment `bounce` on, whose new hit is known. `first` is the power with which
  /// the walk started, `incoming` what the segment carries.
  void resume(std::uint32_t walk, std::uint32_t bounce, const WalkSegment& segment,
    const Power& first, const Power& incoming, WalkTrace& trace) const;

  /// The ray of segment `bounce` of a stored walk.
  Ray storedRay(const WalkBlock& block, std::uint32_t walkInBlock, std::uint32_t walk,
    std::uint32_t bounce) const;

private:
  /// A walk that needs more is in a closed scene that absorbs nothing: it would never end.
  static constexpr std::uint32_t kMostBounces = 1u << 20;

  void follow(std::uint32_t walk, std::uint32_t bounce, WalkSegment segment, Power power,
    std::int64_t threshold, WalkTrace& trace) const;

  const Scene& scene_;
  const SceneObjects& objects_;
  const EmitterTable& emitters_;
  const SobolSequence& samples_;
};

}

#endif
