// SPDX-License-Identifier: BSD-3-Clause
#include "CameraStyle.h"

#include <vtkObjectFactory.h>
#include <vtkRenderWindowInteractor.h>

namespace interactiveroom
{

vtkStandardNewMacro(CameraStyle);

void CameraStyle::OnChar()
{
  const char key = this->Interactor->GetKeyCode();
  if (key == 'q' || key == 'e')
  {
    this->Interactor->ExitCallback();
  }
}

}
