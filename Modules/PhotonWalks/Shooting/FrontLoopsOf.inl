// SPDX-License-Identifier: BSD-3-Clause
// The functions of FrontLoops.h for the instruction set that IRRADIANCE_LEVEL names.

void IRRADIANCE_LEVEL(runStart)(const StartLoop& loop)
{
  runStartLoop<IRRADIANCE_LANES>(loop);
}

void IRRADIANCE_LEVEL(runSurvive)(const SurviveLoop& loop)
{
  runSurviveLoop<IRRADIANCE_LANES>(loop);
}

void IRRADIANCE_LEVEL(runDraw)(const DrawLoop& loop)
{
  runDrawLoop<IRRADIANCE_LANES>(loop);
}

void IRRADIANCE_LEVEL(runPack)(const PackLoop& loop)
{
  runPackLoop<IRRADIANCE_LANES>(loop);
}

void IRRADIANCE_LEVEL(runLeave)(const LeaveLoop& loop)
{
  runLeaveLoop<IRRADIANCE_LANES>(loop);
}

void IRRADIANCE_LEVEL(runSides)(const SidesLoop& loop)
{
  runSidesLoop<IRRADIANCE_LANES>(loop);
}

void IRRADIANCE_LEVEL(runSlots)(const SlotsLoop& loop)
{
  runSlotsLoop<IRRADIANCE_LANES>(loop);
}
