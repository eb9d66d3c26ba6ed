#ifndef irradiance_WalkShooter_h
#define irradiance_WalkShooter_h

#include "Emitter.h"
#include "Scene.h"
#include "WalkHistory.h"

namespace irradiance
{

/// What a walk does at its start and at each hit. A walk is a pure function of the scene, the
/// samples and its number.
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

  const Scene& scene() const { return scene_; }
  WalkStart start(std::uint32_t walk) const { return emitters_.start(walk, samples_); }

  /// What a walk carries on from a hit of segment `bounce`; zero: it ends there. Roulette is played
  /// below `threshold`.
  Power powerAfter(std::uint32_t walk, std::uint32_t bounce, const TriangleId& id,
    const Power& incoming, std::int64_t threshold) const;
  /// The ray with which a walk leaves its hit on `point`, as its segment `bounce`.
  Ray rayFrom(std::uint32_t walk, std::uint32_t bounce, const SurfacePoint& point,
    const TriangleId& id) const;

  /// The ray of a stored segment, the same as when it was shot if the objects stand as they did.
  Ray rayOf(const WalkBlock& block, std::uint32_t walkInBlock, std::uint32_t walk,
    std::uint32_t bounce) const;

  /// Has the memory bring what surfaceAt() and powerAfter() will read; the second when the first has
  /// come.
  void fetchTriangle(const Hit& hit) const;
  void fetchCell(const Hit& hit) const;

private:
  const Scene& scene_;
  const SceneObjects& objects_;
  const EmitterTable& emitters_;
  const SobolSequence& samples_;
};

}

#endif
