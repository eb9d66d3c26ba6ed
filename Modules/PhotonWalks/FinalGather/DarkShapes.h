// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_DarkShapes_h
#define irradiance_DarkShapes_h

#include "Surfaces/CellShapes.h"
#include "Walks/WalkSets.h"

namespace irradiance
{

/// The shapes of all cells of a frame. Marked are sides to which no light can come at all, neither
/// straight from the lights nor from elsewhere: the outer sides of a room; and where direct light
/// is gathered the inner ones of closed dynamic objects.
CellShapes darkShapesOf(const WalkSets& walks, const Frame& frame, const CancelPoint& cancelPoint);

}

#endif
