// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_WalkSampler_h
#define irradiance_WalkSampler_h

#include "Lights/LightTable.h"
#include "Meshes/SurfacePoint.h"
#include "Sampling/SobolSequence.h"
#include "Surfaces/Absorption.h"

#include <vector>

namespace irradiance
{

/// The unit direction in which light that comes `from` a point hits a surface, against its normal.
inline Vector3 incomingDirection(const SurfacePoint& point, const Vector3& from)
{
  const Vector3 incoming = (point.position - from).normalized();
  // Points that touch are too close to tell.
  return incoming.dot(point.normal) < 0 ? incoming : Vector3(-point.normal);
}

/**
 * What a single walk does at its start and at its hits, where WalkStages do not take all walks of a
 * front alike. Knows no scene, so whoever finds the hits may use it.
 */
class WalkSampler
{
public:
  /// The arguments must outlive the sampler.
  WalkSampler(const SceneObjects& objects, const LightTable& lights, const SobolSequence& samples)
    : objects_(objects)
    , lights_(lights)
    , samples_(samples)
  {
  }

  int bands() const { return objects_.staticObject.material->bands; }

  /// The power with which a walk starts; its light decides.
  Power powerOf(std::uint32_t walk) const { return lights_.power(numberOfLight(walk)); }
  /// The light from which a walk starts.
  const Light& lightOf(std::uint32_t walk) const { return lights_[numberOfLight(walk)]; }
  /// The power of every walk, if there is one band.
  Power powerPerWalk() const { return { { lights_.quantaPerWalk() } }; }

  const Material& materialOf(std::uint32_t object) const { return *objects_[object].material; }
  std::uint32_t cellOf(const TriangleId& id) const
  {
    return materialOf(id.object).cellOfTriangle[id.triangle];
  }
  /// How a walk leaves the hit of its segment before `bounce`, given that it survives. `incoming`:
  /// the power of that segment; matters only if there are several bands.
  Reflection reflectionAt(
    const TriangleId& hit, std::uint32_t walk, std::uint32_t bounce, const Power& incoming) const;
  /// The unit direction in which a walk leaves a point specularly for its segment `bounce`.
  /// `point`: of a triangle `id`, turned to the side that is left. `from`: where the segment before
  /// began; its direction follows from this and the hit, as both follow from what is stored.
  Vector3 specularDirection(const SurfacePoint& point, const TriangleId& id, const Vector3& from,
    std::uint32_t walk, std::uint32_t bounce) const;

private:
  std::size_t numberOfLight(std::uint32_t walk) const
  {
    return lights_.choose(samples_.sample(walk, 0, SampleUse::Light)[0]);
  }

  const SceneObjects& objects_;
  const LightTable& lights_;
  const SobolSequence& samples_;
};

}

#endif
