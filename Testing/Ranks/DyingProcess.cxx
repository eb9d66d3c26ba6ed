// SPDX-License-Identifier: BSD-3-Clause
// The last of several processes ends in the middle of an update, in a way that the argument names.
// The others wait for it, and mpirun ends them. (One that calls MPI_Finalize instead waits there
// for the others, as in any program.)

#include "TestScenes.h"

#include "vtkCallbackCommand.h"
#include "vtkMPIController.h"

#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <iostream>
#include <stdexcept>

using namespace TestScenes;

namespace
{

void End(const std::string& how)
{
  std::cout << "pid " << getpid() << " ends by " << how << std::endl;
  if (how == "kill")
  {
    std::raise(SIGKILL);
  }
  std::exit(how == "exit" ? EXIT_FAILURE : EXIT_SUCCESS);
}

}

int main(int argc, char** argv)
{
  vtkNew<vtkMPIController> controller;
  controller->Initialize(&argc, &argv);
  std::cout << "pid " << getpid() << std::endl;
  static const std::string how = argv[1];
  const bool isLast = controller->GetLocalProcessId() == controller->GetNumberOfProcesses() - 1;
  if (isLast && how == "throw")
  {
    throw std::runtime_error("nobody catches this");
  }
  const auto filter = MakeFilter(MakeSmallScene(), 1000000);
  filter->SetController(controller);
  if (isLast)
  {
    vtkNew<vtkCallbackCommand> observer;
    observer->SetCallback([](vtkObject*, unsigned long, void*, void* data) {
      const double progress = *static_cast<double*>(data);
      progress > 0 && progress < 1 ? End(how) : void();
    });
    filter->AddObserver(vtkCommand::ProgressEvent, observer);
  }
  filter->Update();
  std::cout << "pid " << getpid() << " has finished the update" << std::endl;
  controller->Finalize();
  return EXIT_SUCCESS;
}
