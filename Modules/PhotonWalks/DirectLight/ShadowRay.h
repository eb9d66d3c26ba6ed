// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_ShadowRay_h
#define irradiance_ShadowRay_h

#include "Geometry/Vector.h"

#include <array>
#include <cstdint>
#include <limits>

namespace irradiance
{

inline std::array<float, 3> inFloats(const Vector3& v)
{
  return { static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()) };
}

/// A ray from a light to a point, as it was cast: what tells whether a motion may change what it
/// found.
struct ShadowRay
{
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  std::array<float, 3> from;
  std::array<float, 3> to; ///< what stops it, or else the point
  std::uint32_t triangle;  ///< the number of what stops it, or kNone
  bool isStopped : 1;      ///< its light does not arrive
  bool
    touchesMover : 1; ///< where it starts, ends or is stopped, what it meets depends on what can move
};

}

#endif
