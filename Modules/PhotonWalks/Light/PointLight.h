// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PointLight_h
#define irradiance_PointLight_h

#include "Geometry/Vector.h"

#include <cstdint>
#include <vector>

namespace irradiance
{

/// Isotropic point light.
struct PointLight
{
  Vector3 position;         ///< in the space of its object
  std::vector<double> flux; ///< W, one per band
  std::uint32_t cell = 0;   ///< of its object

  friend bool operator==(const PointLight& a, const PointLight& b)
  {
    return a.position == b.position && a.flux == b.flux && a.cell == b.cell;
  }
};

}

#endif
