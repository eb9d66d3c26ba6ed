// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/ControllerRanks.h"

#include "vtkCommunicator.h"
#include "vtkMultiProcessController.h"
#include "vtkType.h"

#include <algorithm>
#include <vector>

namespace irradiance
{

std::uint32_t ControllerRanks::rank() const
{
  return controller_ ? static_cast<std::uint32_t>(controller_->GetLocalProcessId()) : 0;
}

std::uint32_t ControllerRanks::count() const
{
  return controller_ ? static_cast<std::uint32_t>(controller_->GetNumberOfProcesses()) : 1;
}

void ControllerRanks::allReduce(std::int64_t* numbers, std::size_t size)
{
  const std::vector<vtkTypeInt64> own(numbers, numbers + size);
  std::vector<vtkTypeInt64> sums(size);
  controller_->AllReduce(
    own.data(), sums.data(), static_cast<vtkIdType>(size), vtkCommunicator::SUM_OP);
  std::copy(sums.begin(), sums.end(), numbers);
}

}
