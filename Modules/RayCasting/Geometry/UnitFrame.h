// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Vector.h"

#include <algorithm>

namespace irradiance
{

/// unit = (position - center) * scale, where the scale is a power of two. A tree's box becomes
/// about [-1, 1]^3, so that floats suffice at every scale and place, and scaling a scene by 2^k
/// changes nothing.
struct UnitFrame
{
  Vector3 center = Vector3::Zero();
  double scale = 1;

  UnitFrame() = default;
  explicit UnitFrame(const Box& box)
  {
    if (!box.isEmpty())
    {
      // Boxes smaller than 2^-500 count as points, so that the scale stays finite.
      constexpr int kSmallestExponent = -500;
      center = box.center();
      int exponent = 0;
      std::frexp(0.5 * box.extent().maxCoeff(), &exponent);
      // A box without extent is a point, for which any scale will do.
      scale =
        box.extent().maxCoeff() > 0 ? std::ldexp(1.0, -std::max(exponent, kSmallestExponent)) : 1.0;
    }
  }

  Vector3 operator()(const Vector3& position) const { return (position - center) * scale; }
};

}
