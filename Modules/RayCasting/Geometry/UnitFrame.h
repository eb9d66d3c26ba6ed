// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_UnitFrame_h
#define irradiance_UnitFrame_h

#include "Geometry/Vector.h"

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
  explicit UnitFrame(const Box& box);

  Vector3 operator()(const Vector3& position) const { return (position - center) * scale; }
};

}

#endif
