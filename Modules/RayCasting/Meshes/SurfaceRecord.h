// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SurfaceRecord_h
#define irradiance_SurfaceRecord_h

#include "Geometry/Triangle.h"

namespace irradiance
{

/// What rays that leave a triangle need of it, in world space, as SurfaceFormula computes it: a row
/// of 128 bytes. Rows of many triangles are read side by side.
struct alignas(64) SurfaceRecord
{
  double a[3], b[3], c[3]; ///< corners
  double normal[3];        ///< unit, of the front; NaN where there is no area
  double clearance;        ///< how far off the triangle rays start
  double inset[3];         ///< the least weights of a, b, c: points are kept off the edges

  SurfaceRecord() = default;
  explicit SurfaceRecord(const Triangle& world);
};
static_assert(sizeof(SurfaceRecord) == 128);

}

#endif
