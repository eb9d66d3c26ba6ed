// SPDX-License-Identifier: BSD-3-Clause
/** What mouse and keys do, in a file of vtkInteractorEventRecorder. */
#pragma once

#include <vtkSmartPointer.h>

#include <string>

class vtkInteractorEventRecorder;
class vtkRenderWindowInteractor;

namespace interactiveroom
{

/** Plays all events of a file. Throws std::runtime_error that names the file if there is none in it. */
void PlayEvents(const std::string& file, vtkRenderWindowInteractor* interactor);

/** Records while the result lives. Throws std::runtime_error that names the file. */
vtkSmartPointer<vtkInteractorEventRecorder> RecordEvents(
  const std::string& file, vtkRenderWindowInteractor* interactor);

}
