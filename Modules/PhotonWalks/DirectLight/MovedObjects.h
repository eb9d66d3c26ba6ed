// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_MovedObjects_h
#define irradiance_MovedObjects_h

#include "Geometry/Vector.h"

#include <vector>

namespace irradiance
{

/// What a motion moved.
struct MovedObjects
{
  const std::vector<bool>& dynamic; ///< which of the dynamic objects
  std::vector<Box> boxes;           ///< where they are now, with what rounding calls for
};

}

#endif
