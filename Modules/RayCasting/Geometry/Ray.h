// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Vector.h"

#include <array>
#include <cstdint>

namespace irradiance
{

/// A triangle of the scene: object 0 is the static geometry, object i + 1 the i-th dynamic object.
struct TriangleId
{
  static constexpr std::uint32_t kNone = 0xffffffffu;

  std::uint32_t object = kNone;
  std::uint32_t triangle = kNone;

  bool isDynamic() const { return object != kNone && object > 0; }

  friend bool operator==(const TriangleId& a, const TriangleId& b)
  {
    return a.object == b.object && a.triangle == b.triangle;
  }
  friend bool operator!=(const TriangleId& a, const TriangleId& b) { return !(a == b); }
  friend bool operator<(const TriangleId& a, const TriangleId& b)
  {
    return a.object != b.object ? a.object < b.object : a.triangle < b.triangle;
  }
};

/// Half-line in world space. `start` is the triangle that it leaves and cannot hit again.
struct Ray
{
  Vector3 origin;
  Vector3 direction; ///< need not be a unit vector, must not be zero
  TriangleId start;
};

/// Where a ray ends. By default it hits nothing.
struct Hit
{
  double distance = kInfinity; ///< in units of the ray's direction
  TriangleId id;
  /// Barycentric weights of the second and third corner. They are rounded to float, so that a
  /// stored hit defines exactly the point from which the walk continues.
  std::array<float, 2> weights{};

  explicit operator bool() const { return id.object != TriangleId::kNone; }

  friend bool operator==(const Hit& a, const Hit& b)
  {
    return a.distance == b.distance && a.id == b.id;
  }
  friend bool operator!=(const Hit& a, const Hit& b) { return !(a == b); }
};

/// The barycentric weights of all three corners.
inline Vector3 weightsOf(const Hit& hit)
{
  const double b = hit.weights[0], c = hit.weights[1];
  return { 1 - b - c, b, c };
}

}
