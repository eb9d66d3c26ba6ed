// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_LampPiece_h
#define irradiance_LampPiece_h

#include "Geometry/Triangle.h"

#include <cstdint>

namespace irradiance
{

/// A light, or a piece of its triangle, from afar. A light in the air has no normal and shines
/// alike in all directions.
struct LampPiece
{
  std::uint32_t light;
  double share;                             ///< of the light's area
  double flux;                              ///< W, in all bands
  Triangle triangle;                        ///< of an area light
  Vector3 center, normal = Vector3::Zero(); ///< the normal is a unit vector, or zero
  double radius = 0;                        ///< all corners are within it of the center
};

}

#endif
