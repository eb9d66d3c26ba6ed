// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry/UnitFrame.h"

#include <algorithm>
#include <cmath>

namespace irradiance
{

namespace
{

/// Boxes smaller than 2^-500 count as points, so that the scale stays finite.
constexpr int kSmallestExponent = -500;

}

UnitFrame::UnitFrame(const Box& box)
{
  if (!box.isEmpty())
  {
    center = box.center();
    int exponent = 0;
    std::frexp(0.5 * box.extent().maxCoeff(), &exponent);
    // A box without extent is a point, for which any scale will do.
    scale =
      box.extent().maxCoeff() > 0 ? std::ldexp(1.0, -std::max(exponent, kSmallestExponent)) : 1.0;
  }
}

}
