// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PrincipalAxes_h
#define irradiance_PrincipalAxes_h

#include "Geometry/Vector.h"

namespace irradiance
{

/// The columns are the semi-axes of the image of the unit ball under `matrix`, orthogonal to each
/// other, longest first. A short axis is as accurate, relative to its own length, as a long one; an
/// axis of length 0 is a zero column. Scales exactly with powers of two.
Matrix3 principalSemiAxes(const Matrix3& matrix);

}

#endif
