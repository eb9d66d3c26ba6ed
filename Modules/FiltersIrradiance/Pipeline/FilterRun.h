// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_FilterRun_h
#define irradiance_FilterRun_h

#include "Pipeline/SmpExecution.h"

#include "vtkType.h"

#include <functional>

class vtkAlgorithm;
class vtkDataObject;

namespace irradiance
{

/// The latest change of anything upstream of an input. Other than the times of data it does not
/// change with the time that is asked for.
vtkMTimeType upstreamTime(vtkAlgorithm* filter, int port, int connection);

/// VTK's threads, and the filter's progress and abort.
SmpExecution executionOf(vtkAlgorithm* filter, Ranks* ranks = nullptr);

/// Forgets an abort of an earlier run, as the executive does before RequestData. For long work
/// elsewhere.
void forgetAbort(vtkAlgorithm* filter);

/// What RequestData does: lets `compute` fill the output, which is empty at first. After an abort
/// or an exception it is empty again. Returns 0 after an exception, which becomes one error of the
/// filter, else 1. If an input is what another filter failed to compute, the output is empty
/// without a word: that filter has said why, and an empty input would only give errors, or light,
/// that mislead. All `ranks` have to run it; if one fails, all do.
int runFilter(vtkAlgorithm* filter, vtkDataObject* output, const std::function<void()>& compute,
  Ranks* ranks = nullptr);

}

#endif
