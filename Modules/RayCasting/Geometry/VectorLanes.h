// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_VectorLanes_h
#define irradiance_VectorLanes_h

#include "Geometry/Vector.h"

namespace irradiance
{

/// Vectors side by side, component by component, for loops that become SIMD.
template <unsigned kSize>
struct alignas(64) VectorLanes
{
  double x[kSize] = {}, y[kSize] = {}, z[kSize] = {};

  void set(unsigned lane, const Vector3& vector)
  {
    x[lane] = vector[0];
    y[lane] = vector[1];
    z[lane] = vector[2];
  }
  Vector3 get(unsigned lane) const { return { x[lane], y[lane], z[lane] }; }
};

}

#endif
