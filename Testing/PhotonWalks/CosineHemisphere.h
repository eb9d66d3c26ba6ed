// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Sampling/DirectionSampling.h"

namespace irradiance::test
{

/// Unit vector on the hemisphere around the unit vector `normal`, density cos(theta) / pi per
/// steradian, in double. `u`: a point of the unit square.
inline Vector3 sampleCosineHemisphere(const Vector3& normal, const std::array<double, 2>& u)
{
  return directionAround(normal, std::sqrt(1 - u[0]), std::sqrt(u[0]), u[1]);
}

}
