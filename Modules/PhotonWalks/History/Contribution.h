// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Contribution_h
#define irradiance_Contribution_h

#include "Geometry/Ray.h"
#include "History/SegmentRef.h"
#include "Surfaces/Power.h"

namespace irradiance
{

/// What a stored segment brings to the cell that it hits: all that it carries.
struct Contribution
{
  SegmentRef segment;
  Hit hit; ///< without its distance
  bool isFront;
  Power power;
};

}

#endif
