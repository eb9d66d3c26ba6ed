// SPDX-License-Identifier: BSD-3-Clause
#include "EventFile.h"

#include <vtkCommand.h>
#include <vtkInteractorEventRecorder.h>
#include <vtkNew.h>
#include <vtkRenderWindowInteractor.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace interactiveroom
{
namespace
{

// The recorder passes over what it does not know, and does not say so.
void RequireEvents(const std::string& file)
{
  std::ifstream lines(file);
  bool isPlayed = false;
  int number = 0;
  for (std::string line; std::getline(lines, line);)
  {
    ++number;
    std::string event;
    std::istringstream(line) >> event;
    if (event.empty() || event[0] == '#')
    {
      continue;
    }
    if (vtkCommand::GetEventIdFromString(event.c_str()) == vtkCommand::NoEvent)
    {
      throw std::runtime_error("--events: " + file + ", line " + std::to_string(number) + ": \"" +
        event.substr(0, 40) + "\" is no event of VTK");
    }
    isPlayed = true;
  }
  if (!isPlayed)
  {
    throw std::runtime_error("--events: " + file + ": there is no event in it");
  }
}

}

void PlayEvents(const std::string& file, vtkRenderWindowInteractor* interactor)
{
  RequireEvents(file);
  vtkNew<vtkInteractorEventRecorder> recorder;
  recorder->SetInteractor(interactor);
  recorder->SetFileName(file.c_str());
  recorder->Play();
}

vtkSmartPointer<vtkInteractorEventRecorder> RecordEvents(
  const std::string& file, vtkRenderWindowInteractor* interactor)
{
  if (!std::ofstream(file))
  {
    throw std::runtime_error("--record: " + file + " cannot be written");
  }
  auto recorder = vtkSmartPointer<vtkInteractorEventRecorder>::New();
  recorder->SetInteractor(interactor);
  recorder->SetFileName(file.c_str());
  recorder->On();
  recorder->Record();
  return recorder;
}

}
