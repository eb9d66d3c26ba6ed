// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PrincipalAxes_h
#define irradiance_PrincipalAxes_h

#include "Geometry/Vector.h"

namespace irradiance
{

/// The ellipsoid that `matrix` makes of the unit ball: columns are its semi-axes, at right angles
/// to each other, longest first. A short axis is as accurate, in relation to its own length, as a
/// long one; an axis of length 0 is a zero column. Scales exactly with powers of two.
Matrix3 principalSemiAxes(const Matrix3& matrix);

}

#endif
