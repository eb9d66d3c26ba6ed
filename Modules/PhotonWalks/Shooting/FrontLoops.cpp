// SPDX-License-Identifier: BSD-3-Clause
#include "Shooting/FrontLoops.h"

#include "Simd/SimdLevel.h"

namespace irradiance
{

void runStart(const StartLoop& loop)
{
  IRRADIANCE_CALL_BEST(runStart, loop);
}

void runSurvive(const SurviveLoop& loop)
{
  IRRADIANCE_CALL_BEST(runSurvive, loop);
}

void runDraw(const DrawLoop& loop)
{
  IRRADIANCE_CALL_BEST(runDraw, loop);
}

void runPack(const PackLoop& loop)
{
  IRRADIANCE_CALL_BEST(runPack, loop);
}

void runLeave(const LeaveLoop& loop)
{
  IRRADIANCE_CALL_BEST(runLeave, loop);
}

void runSides(const SidesLoop& loop)
{
  IRRADIANCE_CALL_BEST(runSides, loop);
}

void runSlots(const SlotsLoop& loop)
{
  IRRADIANCE_CALL_BEST(runSlots, loop);
}

}
