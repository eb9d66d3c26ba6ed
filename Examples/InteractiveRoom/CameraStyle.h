// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkInteractorStyleTrackballCamera.h>

namespace interactiveroom
{

/** The mouse turns the view. Of the keys that VTK's styles take, q and e alone have a meaning: to quit. */
class CameraStyle : public vtkInteractorStyleTrackballCamera
{
public:
  static CameraStyle* New();
  vtkTypeMacro(CameraStyle, vtkInteractorStyleTrackballCamera);

  void OnChar() override;
};

}
