// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Vector.h"
#include "Progress/CancelPoint.h"

#include <array>
#include <vector>

namespace irradiance
{

/// The columns are the semi-axes of the image of the unit ball under `matrix`, orthogonal to each
/// other, longest first. A short axis is as accurate, relative to its own length, as a long one; an
/// axis of length 0 is a zero column. Scales exactly with powers of two.
Matrix3 principalSemiAxes(const Matrix3& matrix);

/// The frame, along the principal directions of a set of points, in which the points fill [-1,1]^3.
struct CubeFrame
{
  Vector3 origin;             // in the model
  Matrix3 axes;               // columns: orthonormal principal directions
  Vector3 halfWidth;          // along the axes, in model length, never 0
  std::array<bool, 3> isFlat; // the points do not reach +-1 along this axis

  Vector3 fromModel(const Vector3& point) const
  {
    return (axes.transpose() * (point - origin)).cwiseQuotient(halfWidth);
  }
};

/// An axis along which the points have no extent gets 2^-20 of the longest, or 2^-44 of the
/// distance from the origin if that is more. Scales exactly with powers of two.
CubeFrame cubeFrame(const std::vector<Vector3>& points, const CancelPoint& cancelPoint = {});

}
