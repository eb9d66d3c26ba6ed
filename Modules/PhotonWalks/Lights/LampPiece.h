// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Lights/Light.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace irradiance
{

/// The mean of what is above 0 of a cosine that is even between two values.
inline double positivePart(double lower, double upper)
{
  return lower >= 0 ? 0.5 * (lower + upper) : upper > 0 ? upper * upper / (2 * (upper - lower)) : 0;
}

/// Into which directions lamps shine: around normals that fill a cone, around each with the cosine.
struct LampCone
{
  /// Of the half angle: 1 of a flat lamp, -1 if light leaves to all sides.
  double cosine = -1, sine = 0;

  bool isFlat() const { return cosine >= 1; }
  /// Into which they shine, sr.
  /// Conty and Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting", 2018.
  double solidAngle() const
  {
    const double cone = std::acos(cosine), most = std::min(kPi, cone + kPi / 2);
    return 2 * kPi * (1 - cosine) +
      kPi / 2 * (2 * most * sine - std::cos(cone - 2 * most) - 2 * cone * sine + cosine);
  }
  /// The intensity for each W, times kProjected, in directions with a cosine to the axis: a mean,
  /// as normals have all cosines of the cone alike. `size`: the sine of the angle by which
  /// directions may differ: the nearest counts.
  double leaving(double ofDirection, double size) const
  {
    const double ofSize = std::sqrt(1 - size * size);
    const double sineOfDirection = std::sqrt(std::max(0.0, 1 - ofDirection * ofDirection));
    const bool isWithin = ofDirection >= ofSize;
    const double nearest = isWithin ? 1 : ofDirection * ofSize + sineOfDirection * size;
    const double sineOfNearest =
      isWithin ? 0 : std::abs(sineOfDirection * ofSize - ofDirection * size);
    const double lower = nearest <= -cosine ? -1 : nearest * cosine - sineOfNearest * sine;
    const double upper = nearest >= cosine ? 1 : nearest * cosine + sineOfNearest * sine;
    return positivePart(lower, upper);
  }
  /// The largest intensity, W/sr, is the flux over this: the integral of the cosine.
  static constexpr double kProjected = kPi;
};

/// A light, or a piece of its triangle, from afar. A light in the air is a point. A part of a distant
/// one stands as far away as makes no difference.
struct LampPiece
{
  std::uint32_t light;
  double share;                             ///< of the light's area
  double flux;                              ///< W, in all bands
  Triangle triangle;                        ///< of a light in the air, a point
  Vector3 center, normal = Vector3::Zero(); ///< a unit vector along the axis of the cone, or zero
  double radius = 0;                        ///< all corners are within it of the center
  LampCone cone{};
  const IntensityDistribution* distribution = nullptr; ///< of a luminaire
  IntensityDistribution::Face face{};                  ///< of which it is a part; none of all faces
  const DistantLight::Part* part = nullptr;            ///< of a distant light
  /// m2, if it is distant, else 0: a plane across its light receives the flux over this, W/m2.
  double crossSection = 0;

  Box bounds() const { return triangle.bounds(); }
};

/// Appends a light as it is seen from afar. Long triangles are cut, but no edges that are shorter
/// than `shortest`, m. `number`: of the light.
void addPieces(
  const Light& light, std::uint32_t number, double shortest, std::vector<LampPiece>& pieces);

}
