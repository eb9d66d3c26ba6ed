// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkMPIController.h"

/// Those that mpirun has started.
namespace Processes
{

/// Of all of them; null before main().
extern vtkMPIController* Controller;

inline int Count()
{
  return Controller->GetNumberOfProcesses();
}

inline int Own()
{
  return Controller->GetLocalProcessId();
}

inline bool IsLast()
{
  return Own() + 1 == Count();
}

/// All have to call it.
inline int Sum(int own)
{
  int sum = 0;
  Controller->AllReduce(&own, &sum, 1, vtkCommunicator::SUM_OP);
  return sum;
}

}
