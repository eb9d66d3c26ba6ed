// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "LightGroups.h"

#include <vector>

namespace irradiance
{

/// The lamps of a part of the scene, and how much of their light lamps stop.
struct CoveredLamps
{
  SceneCell lamp;     ///< one of the part
  SceneCell cover;    ///< a lamp whose back stops their light
  double watts = 0;   ///< that the part emits
  double covered = 0; ///< the share that meets the back of a lamp first
};

/// The parts with lamps of which lamps cover a quarter or more, roughly. Of the light that is bound
/// for surfaces that are no lamps counts what lamps stop with their backs: rays go from points of
/// the lamps to points of these surfaces, each with the power that it would bring to a patch there.
/// So a sun counts whose light hardly meets the scene. What falls on the front of a lamp does not:
/// lamps may face each other. Of the lamps of a group; `areOthers`: there are other groups, whose
/// lamps may stop their light, too.
std::vector<CoveredLamps> findCoveredLamps(
  const LightGroup& group, bool areOthers, const CancelPoint& cancelPoint);

}
