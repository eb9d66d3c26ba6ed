// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_AreaLight_h
#define irradiance_AreaLight_h

#include "Geometry/Ray.h"
#include "Meshes/SurfacePoint.h"
#include "Sampling/DirectionSampling.h"
#include "Surfaces/SceneObjects.h"

namespace irradiance
{

/// A triangle of a cell with exitance, in world space. Light leaves its front as it would after
/// diffuse reflection.
struct AreaLight
{
  TriangleId id;
  Triangle triangle;

  /// What the cosine to the normal is times, for the intensity of each W, 1/sr.
  static constexpr double kPerSteradian = 1 / kPi;
  /// m2 sr: the flux over this is the radiance, W/m2/sr, in all directions.
  static double etendue(const Triangle& triangle) { return kPi * triangle.area(); }

  Box bounds() const { return triangle.bounds(); }
  Ray leaving(const std::array<double, 2>& place, const std::array<double, 2>& direction) const
  {
    const SurfacePoint point = surfacePoint(triangle, sampleTriangle(place));
    return { point.clearPosition(), sampleHemisphere(point.normal, direction), id };
  }

  friend bool operator==(const AreaLight& a, const AreaLight& b)
  {
    return a.id == b.id && a.triangle == b.triangle;
  }
};

/// pi times the radiance of what a side of a cell emits, W/m2/sr, alike in all directions: one
/// value per band; null: nothing.
inline const double* emittedFrom(const SceneObject& object, std::size_t cell, bool isFront)
{
  return isFront ? object.exitanceOf(cell) : nullptr;
}

}

#endif
