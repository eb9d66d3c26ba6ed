// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_AgreedChange_h
#define irradiance_AgreedChange_h

#include "IrradianceEngine.h"

namespace irradiance
{

/// What all ranks do for a frame: a fresh start if one of them needs it. `before`: the objects of
/// the frame before. Throws RankFailed if they have not been given the same.
FrameChange agreedChange(const FrameChange& change, const SceneObjects& objects,
  const SceneObjects& before, const EngineSettings& settings, Ranks& ranks);

}

#endif
