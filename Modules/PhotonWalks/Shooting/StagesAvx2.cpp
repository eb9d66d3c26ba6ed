// SPDX-License-Identifier: BSD-3-Clause
#ifdef __x86_64__

#include "Shooting/Stages.h"
#include "Simd/SimdTarget.h"

IRRADIANCE_TARGET_BEGIN(IRRADIANCE_AVX2)

namespace irradiance
{

void drawAllAvx2(SampleLanes& samples)
{
  samples.draw();
}

void drawAllFirstAvx2(SampleLanes& samples)
{
  samples.drawFirst();
}

void scatterAllAvx2(ScatterLanes& lanes)
{
  lanes.leave();
}

}

IRRADIANCE_TARGET_END

#endif
