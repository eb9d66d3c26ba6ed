// SPDX-License-Identifier: BSD-3-Clause
#include "Processes.h"

#include "vtkNew.h"

#include <gtest/gtest.h>

vtkMPIController* Processes::Controller = nullptr;

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  // After a failure a process may do less than the others, which then wait for it. When it dies,
  // mpirun ends them.
  testing::GTEST_FLAG(break_on_failure) = true;
  vtkNew<vtkMPIController> controller;
  controller->Initialize(&argc, &argv);
  Processes::Controller = controller;
  const int result = RUN_ALL_TESTS();
  controller->Finalize();
  return result;
}
