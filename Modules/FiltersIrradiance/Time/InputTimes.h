// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_InputTimes_h
#define irradiance_InputTimes_h

#include "Time/ExposureTimes.h"

class vtkAlgorithm;
class vtkExecutive;
class vtkInformation;

namespace irradiance
{

/// Throws InputError if the data of an input are not of the time that was asked for.
void checkTime(vtkInformation* input, double time, const TimeSpan& span);

/// Whether anything upstream of an output came with another time than asked for, as files do
/// between their steps.
bool comesAtStepsOnly(vtkExecutive* executive, int port, const TimeSpan& span);

/// Whether a filter upstream was aborted. Its output, and what came of it, is empty but counts as
/// up to date; then it counts as data of no time, so that the next update computes it.
bool forgetAborted(vtkExecutive* executive);

}

#endif
