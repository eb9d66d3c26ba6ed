// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Stages_h
#define irradiance_Stages_h

#include "Sampling/SampleLanes.h"
#include "Shooting/LeavingLanes.h"

namespace irradiance
{

/// The stages of a walk that are loops over lanes, each with the best instructions of the machine.
/// All give the same bits.
void drawAll(SampleLanes& samples);
void drawAllFirst(SampleLanes& samples);
void leaveAll(LeavingLanes& lanes);

void drawAllPlain(SampleLanes& samples);
void drawAllAvx2(SampleLanes& samples);
void drawAllAvx512(SampleLanes& samples);
void drawAllFirstPlain(SampleLanes& samples);
void drawAllFirstAvx2(SampleLanes& samples);
void drawAllFirstAvx512(SampleLanes& samples);
void leaveAllPlain(LeavingLanes& lanes);
void leaveAllAvx2(LeavingLanes& lanes);
void leaveAllAvx512(LeavingLanes& lanes);

}

#endif
