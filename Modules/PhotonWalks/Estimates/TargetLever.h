// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_TargetLever_h
#define irradiance_TargetLever_h

#include "Estimates/CellEstimator.h"

#include <optional>

namespace irradiance
{

/// What may be doubled where a target is missed.
enum class TargetLever
{
  Walks,
  Rays
};

/**
 * The lever that promises more for its time, once the first `rounds` have missed a target; nothing
 * if none is left that may help. The time is counted, in segments that the lever would add. So the
 * choice is a pure function of the scene and the settings.
 */
std::optional<TargetLever> chooseLever(const TargetMiss& miss, const EstimateRounds& rounds,
  const WalkSets& walks, const CellEstimator& estimator);

}

#endif
