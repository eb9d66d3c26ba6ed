// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_EllipsoidLanes_h
#define irradiance_EllipsoidLanes_h

#include "Kernels/TreeRays.h"

#include <type_traits>

namespace irradiance
{

/// An ellipsoid as floats can test it: every point of the object is `center` + y / `scale` with
/// |roundFromScaled y| <= a radius. Documentation/Theory.md, section 3, derives what pays for rounding.
struct EllipsoidFilter
{
  double center[3];
  double scale;             ///< a power of two; the longest row of the map is about 1 then
  float roundFromScaled[9]; ///< row by row
  float squaredRadius;      ///< widened
  float byDistance;         ///< more of it, per squared distance of the ray's origin
};

/// Tests 16 rays against the ellipsoid around an object, wherever they end: most miss most objects.
struct EllipsoidLanes
{
  static constexpr unsigned kSize = TreeRays::kLanes;
  /// Of the two squares whose difference is a squared distance; some 16 roundings of 2^-24.
  static constexpr float kCancelled = 0x1p-19F;

  /// Squared lengths of directions in double; rays whose direction is shorter or longer pass.
  static constexpr double kShortest = 0x1p-200, kLongest = 0x1p200;

  /// The rays from `first` on that may touch it, one bit each. Is compiled once for each
  /// instruction set.
  template <class Real>
  __attribute__((always_inline)) static unsigned passing(const TreeRays& rays,
    const Real* const (&directions)[3], std::uint32_t first, const EllipsoidFilter& filter)
  {
    const double *ox = rays.origin[0] + first, *oy = rays.origin[1] + first,
                 *oz = rays.origin[2] + first;
    const Real *dx = directions[0] + first, *dy = directions[1] + first,
               *dz = directions[2] + first;
    const double centerX = filter.center[0], centerY = filter.center[1], centerZ = filter.center[2],
                 scale = filter.scale;
    const float* const w = filter.roundFromScaled;
    const float w0 = w[0], w1 = w[1], w2 = w[2], w3 = w[3], w4 = w[4], w5 = w[5], w6 = w[6],
                w7 = w[7], w8 = w[8];
    const float squaredRadius = filter.squaredRadius, byDistance = filter.byDistance;
    alignas(64) float gap[kSize];
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      const float x = static_cast<float>((centerX - ox[lane]) * scale),
                  y = static_cast<float>((centerY - oy[lane]) * scale),
                  z = static_cast<float>((centerZ - oz[lane]) * scale);
      const float px = w0 * x + w1 * y + w2 * z, py = w3 * x + w4 * y + w5 * z,
                  pz = w6 * x + w7 * y + w8 * z;
      // Directions in floats have length 1.
      const double squaredLength = std::is_same_v<Real, float>
        ? 1.0
        : dx[lane] * dx[lane] + dy[lane] * dy[lane] + dz[lane] * dz[lane];
      const double unit = std::is_same_v<Real, float> ? 1.0 : 1 / __builtin_sqrt(squaredLength);
      const float ex = static_cast<float>(dx[lane] * unit),
                  ey = static_cast<float>(dy[lane] * unit),
                  ez = static_cast<float>(dz[lane] * unit);
      const float qx = w0 * ex + w1 * ey + w2 * ez, qy = w3 * ex + w4 * ey + w5 * ez,
                  qz = w6 * ex + w7 * ey + w8 * ez;
      const float towards = px * qx + py * qy + pz * qz;
      const float along = towards > 0 ? towards : 0;
      const float distance = px * px + py * py + pz * pz, length = qx * qx + qy * qy + qz * qz;
      const float reach =
        squaredRadius + byDistance * (x * x + y * y + z * z) + kCancelled * distance;
      // By Pythagoras, times the length: without a division or a root, but with cancellation.
      const bool isExact = (squaredLength > kShortest) & (squaredLength < kLongest);
      gap[lane] = isExact ? (distance * length - along * along) - reach * length : 0.0F;
    }
    unsigned bits = 0;
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      bits |= (gap[lane] > 0 ? 0u : 1u) << lane; // NaN passes
    }
    return bits;
  }
};

}

#endif
