// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Eye_h
#define irradiance_Eye_h

#include "Geometry/Vector.h"

#include <cmath>

namespace irradiance
{

/// Who looks: from a point, or from infinitely far away (parallel projection).
struct Eye
{
  Vector3 position; ///< or the unit direction to the eye
  bool isFar = false;

  /// A unit vector; zero at the eye's own place.
  Vector3 directionFrom(const Vector3& point) const
  {
    if (isFar)
    {
      return position;
    }
    const Vector3 away = position - point;
    const double squared = away.squaredNorm();
    if (squared > 0x1p-900 && squared < 0x1p+1000)
    {
      return away / std::sqrt(squared);
    }
    const double longest = away.cwiseAbs().maxCoeff(); // its square is too large or small
    return longest > 0 ? Vector3((away / longest).normalized()) : away;
  }
};

}

#endif
