// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_RankData_h
#define irradiance_RankData_h

#include "Execution/Ranks.h"

#include "vtkSmartPointer.h"

#include <vector>

class vtkDataObject;
class vtkMultiProcessController;

namespace irradiance
{

/// What each rank has, in the order of ranks, on all of them; ranks that have nothing (null) are
/// left out. All ranks call it. `controller`: of these ranks. Alone: `own`. Throws RankFailed, and
/// InputError of messageOf().
std::vector<vtkSmartPointer<vtkDataObject>> dataOfRanks(
  vtkDataObject* own, vtkMultiProcessController* controller, Ranks& ranks);

}

#endif
