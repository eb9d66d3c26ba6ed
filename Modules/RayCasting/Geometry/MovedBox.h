// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_MovedBox_h
#define irradiance_MovedBox_h

#include "Geometry/Vector.h"

namespace irradiance
{

/// Bounds of a box that a map has moved; empty if the box is empty. Not rounded outwards.
inline Box movedBox(const AffineMap& map, const Box& box)
{
  if (box.isEmpty())
  {
    return {};
  }
  const Vector3 center = map(box.center());
  const Vector3 reach = 0.5 * map.linear.cwiseAbs() * box.extent();
  return { center - reach, center + reach };
}

}

#endif
