// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Vector.h"
#include "Progress/CancelPoint.h"

#include <vector>

namespace irradiance
{

/// The solid ellipsoid { x : |shape * (x - center)| <= 1 }, in the frame of the points it encloses.
/// Row i of `shape` is the direction of principal axis i divided by the length of its semi-axis,
/// longest axis first. This keeps the inverse of `shape` accurate however flat the ellipsoid is.
struct EnclosingEllipsoid
{
  Vector3 center = Vector3::Zero();
  Matrix3 shape = Matrix3::Identity();
};

/// The smallest ellipsoid around `points`, up to about 1 % in volume.
///
/// Every point lies inside in exact arithmetic, for any set: one point, a line, a door.
/// A direction in which the set has no extent gets a thickness of 2^-20 of its length, or of
/// 2^-44 of its distance from the origin if that is more. Scaling the points by a power of two
/// scales the result exactly.
///
/// Throws std::invalid_argument if there is no point, or if a coordinate is not finite or
/// exceeds 1e38 in absolute value.
EnclosingEllipsoid encloseByEllipsoid(
  const std::vector<Vector3>& points, const CancelPoint& cancelPoint = {});

}
