// SPDX-License-Identifier: BSD-3-Clause
#include "Shooting/Stages.h"

#include "Simd/SimdLevel.h"

namespace irradiance
{

void drawAllPlain(SampleLanes& samples)
{
  samples.draw();
}

void drawAllFirstPlain(SampleLanes& samples)
{
  samples.drawFirst();
}

void scatterAllPlain(ScatterLanes& lanes)
{
  lanes.leave();
}

void drawAll(SampleLanes& samples)
{
  IRRADIANCE_CALL_BEST(drawAll, samples);
}

void drawAllFirst(SampleLanes& samples)
{
  IRRADIANCE_CALL_BEST(drawAllFirst, samples);
}

void scatterAll(ScatterLanes& lanes)
{
  IRRADIANCE_CALL_BEST(scatterAll, lanes);
}

}
