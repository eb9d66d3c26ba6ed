// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Execution/Execution.h"
#include "Geometry/Ray.h"
#include "Surfaces/SceneObjects.h"

#include <array>
#include <utility>
#include <vector>

namespace irradiance
{

/// Triangles nearer than this, of the largest coordinate, coincide. So a point from which a ray
/// leaves one of them, 2^-33 above it, is on the same side of the other as well, or known to touch.
constexpr double kTouching = 0x1p-32;

std::array<const Vector3*, 3> cornersOf(const Triangle& triangle);
/// For each edge the direction in the triangle's plane that points from it to the inside.
std::array<Vector3, 3> inwardOf(const Triangle& triangle);
/// A box that holds all that touches this one.
Box touchedBox(Box box);

Triangle worldTriangle(const SceneObject& object, std::uint32_t triangle);
Triangle worldTriangle(const SceneObjects& objects, const TriangleId& id);
/// Triangles of an object that may touch a box in the world.
std::vector<std::uint32_t> trianglesNear(const SceneObject& object, const Box& world);

/// A triangle, and what tells quickly whether others coincide with it.
class FlatTriangle
{
public:
  explicit FlatTriangle(const Triangle& triangle);

  /// Two triangles coincide if they overlap and one lies within twice SurfacePoint::clearance of
  /// the other's plane.
  bool coincidesWith(const Triangle& other) const;
  /// Unit vector.
  const Vector3& normal() const { return normal_; }

private:
  bool isSeparatedFrom(const Triangle& other, double tolerance) const;
  bool isInPlaneOf(const Triangle& other, double tolerance) const;

  Triangle triangle_;
  Vector3 normal_;
  std::array<Vector3, 3> inward_;
  double magnitude_;
};

using TrianglePair = std::pair<std::uint32_t, std::uint32_t>;

/// For each body its triangles that coincide, by number: first < second, in order.
std::vector<std::vector<TrianglePair>> coincidentWithin(
  const std::vector<const RigidObject*>& bodies, Execution& execution);

/// The triangles of two objects that coincide in the world: of the first object, of the second.
std::vector<TrianglePair> coincidentBetween(
  const SceneObject& first, const SceneObject& second, const CancelPoint& cancelPoint);

}
