// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_AgreedChange_h
#define irradiance_AgreedChange_h

#include "Estimates/CellEstimate.h"
#include "Execution/Ranks.h"
#include "Repair/SceneChange.h"
#include "Walks/WalkSettings.h"

namespace irradiance
{

/// What a rank is given for a frame.
struct FrameInput
{
  const SceneObjects& objects;
  const SceneObjects& before; ///< of the frame before
  const WalkSettings& walks;
  const EstimateSettings& estimate;
};

/// What all ranks do for a frame: a fresh start if one of them needs it. Throws RankFailed if they
/// have not been given the same.
FrameChange agreedChange(const FrameChange& change, const FrameInput& input, Ranks& ranks);

}

#endif
