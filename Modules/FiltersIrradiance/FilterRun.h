// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_FilterRun_h
#define irradiance_FilterRun_h

#include "SmpExecution.h"

#include <functional>

class vtkAlgorithm;
class vtkDataObject;

namespace irradiance
{

/// VTK's threads, and the filter's progress and abort.
SmpExecution executionOf(vtkAlgorithm* filter);

/// What RequestData does: lets `compute` fill the output, which is empty at first. After an abort or an
/// exception it is empty again. Returns 0 after an exception, which becomes one error of the filter,
/// else 1.
int runFilter(vtkAlgorithm* filter, vtkDataObject* output, const std::function<void()>& compute);

}

#endif
