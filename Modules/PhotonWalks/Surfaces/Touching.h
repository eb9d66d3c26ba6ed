// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Touching_h
#define irradiance_Touching_h

#include "Geometry/Ray.h"
#include "Surfaces/SceneObjects.h"

#include <array>
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

}

#endif
