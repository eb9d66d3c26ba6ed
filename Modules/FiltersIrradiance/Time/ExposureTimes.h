// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_ExposureTimes_h
#define irradiance_ExposureTimes_h

#include "Exposure/IntegrationTimes.h"

#include <optional>
#include <vector>

class vtkInformation;

namespace irradiance
{

/// The span of an exposure, given the properties of the same names (NaN: the end of what the input
/// has). Throws InputError.
TimeSpan timeSpan(vtkInformation* input, double startTime, double endTime);

/// The ends of the span and the TIME_STEPS of the input between them. Throws InputError.
std::vector<double> stepTimes(vtkInformation* input, const TimeSpan& span);

/// A time at which the input has no step, if it has TIME_STEPS.
std::optional<double> timeBetweenSteps(vtkInformation* input, const TimeSpan& span);

}

#endif
