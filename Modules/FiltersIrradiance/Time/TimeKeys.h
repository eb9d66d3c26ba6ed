// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Exposure/IntegrationTimes.h"

#include <optional>
#include <vector>

class vtkExecutive;
class vtkInformation;
class vtkInformationVector;

namespace irradiance
{

/// The TIME_STEPS of an input, in order, each once.
std::vector<double> stepsOf(vtkInformation* input);

/// Sets TIME_STEPS and TIME_RANGE of a filter with several inputs, on all outputs: the steps of all
/// connections of the first `ports` input ports, with `further` ones, and the range that holds all
/// steps and ranges; removes them where there are no times. VTK's executive passes on the times of
/// the first input alone, and a filter without TIME_RANGE does not execute when the time changes.
void uniteTimes(vtkInformationVector** inputs, int ports, vtkInformationVector* outputs,
  const std::vector<double>& further = {});

/// The span of an exposure, given the properties of the same names (NaN: the end of what the input
/// has). Throws InputError.
TimeSpan timeSpan(vtkInformation* input, double startTime, double endTime);

/// The ends of the span and the TIME_STEPS of the input between them. Throws InputError.
std::vector<double> stepTimes(vtkInformation* input, const TimeSpan& span);

/// A time at which the input has no step, if it has TIME_STEPS.
std::optional<double> timeBetweenSteps(vtkInformation* input, const TimeSpan& span);

/// Throws InputError if the data of an input are not of the time that was asked for.
void checkTime(vtkInformation* input, double time, const TimeSpan& span);

/// Whether anything upstream of an output came with another time than asked for, as files do
/// between their steps.
bool comesAtStepsOnly(vtkExecutive* executive, int port, const TimeSpan& span);

/// Whether a filter upstream was aborted. Its output, and what came of it, is empty but counts as
/// up to date; then it counts as data of no time, so that the next update computes it.
bool forgetAborted(vtkExecutive* executive);

}
