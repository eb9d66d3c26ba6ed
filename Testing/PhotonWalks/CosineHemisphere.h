// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_test_CosineHemisphere_h
#define irradiance_test_CosineHemisphere_h

#include "Sampling/DirectionSampling.h"

namespace irradiance::test
{

/// The direction in which a walk leaves a diffuse surface.
inline Vector3 sampleCosineHemisphere(const Vector3& normal, const std::array<double, 2>& u)
{
  const CosineDirection direction(normal[0], normal[1], normal[2], u[0], u[1]);
  return { direction.x, direction.y, direction.z };
}

}

#endif
