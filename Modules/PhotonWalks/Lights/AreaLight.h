// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_AreaLight_h
#define irradiance_AreaLight_h

#include "Geometry/Ray.h"
#include "Geometry/Triangle.h"

namespace irradiance
{

/// A triangle of a cell with exitance, in world space. Light leaves its front as it would after
/// diffuse reflection.
struct AreaLight
{
  TriangleId id;
  Triangle triangle;

  Box bounds() const { return triangle.bounds(); }

  friend bool operator==(const AreaLight& a, const AreaLight& b)
  {
    return a.id == b.id && a.triangle == b.triangle;
  }
};

}

#endif
