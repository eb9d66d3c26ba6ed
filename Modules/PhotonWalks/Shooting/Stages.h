// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Stages_h
#define irradiance_Stages_h

#include "Sampling/SampleLanes.h"
#include "Shooting/ScatterLanes.h"

namespace irradiance
{

/// The stages of a walk that are loops over lanes, each with the best instructions of the machine.
/// All give the same bits.
void drawAll(SampleLanes& samples);
void drawAllFirst(SampleLanes& samples);
void scatterAll(ScatterLanes& lanes);

void drawAllPlain(SampleLanes& samples);
void drawAllAvx2(SampleLanes& samples);
void drawAllAvx512(SampleLanes& samples);
void drawAllFirstPlain(SampleLanes& samples);
void drawAllFirstAvx2(SampleLanes& samples);
void drawAllFirstAvx512(SampleLanes& samples);
void scatterAllPlain(ScatterLanes& lanes);
void scatterAllAvx2(ScatterLanes& lanes);
void scatterAllAvx512(ScatterLanes& lanes);

}

#endif
