// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PaddedRay_h
#define irradiance_PaddedRay_h

#include "Geometry/Vector.h"

#include <algorithm>

namespace irradiance
{

/// A ray as a kd-tree traversal in double needs it. All cells are widened by `pad`, 2^-36 of the
/// reach, which is far more than any rounding. Documentation/Theory.md has the reasons.
struct PaddedRay
{
  struct Axis
  {
    double origin;
    double inverse; ///< of the direction
    double pad;     ///< on the ray
    unsigned nearChild;
  };

  Axis axes[3];
  double reach; ///< from the origin to the far corner of the box, by the largest component
  double from = -kInfinity, to = kInfinity; ///< the part inside the box

  PaddedRay(const Box& box, const Vector3& origin, const Vector3& direction)
    : reach(std::max(
        (box.lower - origin).cwiseAbs().maxCoeff(), (box.upper - origin).cwiseAbs().maxCoeff()))
  {
    for (int i = 0; i < 3; ++i)
    {
      const double inverse = std::abs(direction[i]) < kParallel
        ? std::copysign(1 / kParallel, direction[i])
        : 1 / direction[i];
      const double pad = 0x1p-36 * reach * std::abs(inverse);
      const double lower = (box.lower[i] - origin[i]) * inverse;
      const double upper = (box.upper[i] - origin[i]) * inverse;
      from = std::max(from, std::min(lower, upper) - pad);
      to = std::min(to, std::max(lower, upper) + pad);
      axes[i] = { origin[i], inverse, pad, inverse < 0 ? 1u : 0u };
    }
  }

private:
  static constexpr double kParallel = 1e-150;
};

}

#endif
