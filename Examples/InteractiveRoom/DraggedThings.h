// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "LightFollower.h"
#include "SceneView.h"

#include <vtkBoxRepresentation.h>
#include <vtkBoxWidget2.h>
#include <vtkCellPicker.h>

class vtkRenderWindowInteractor;

namespace interactiveroom
{

/**
 * The mouse and the keys move things. A press of the left button chooses the thing under it, which
 * gets a box (vtkBoxWidget2): dragged, it moves; with Shift, it turns. Things stay in the limits of
 * the room.
 */
class DraggedThings
{
public:
  DraggedThings(const Room& room, LightFollower& light, SceneView& view, vtkRenderer* renderer,
    vtkRenderWindowInteractor* interactor);

  int GetChosen() const { return this->Chosen; }
  void Choose(int thing);
  void ChooseNext();

  /** By so many m, in the world. */
  void Move(double x, double y, double z);
  /** About the vertical through its middle, degrees. */
  void Turn(double angle);
  /** All things to where they were at the start. */
  void Reset();

private:
  void ChooseUnderMouse(vtkObject*, unsigned long, void*);
  void TakePoseOfBox(vtkObject*, unsigned long, void*);
  void SetPose(vtkTransform* worldFromMesh);
  void PlaceBox();

  const Room& TheRoom;
  LightFollower& Light;
  vtkRenderer* Renderer;
  vtkRenderWindowInteractor* Interactor;
  vtkNew<vtkBoxRepresentation> Box;
  vtkNew<vtkBoxWidget2> Widget;
  vtkNew<vtkCellPicker> Picker;
  std::vector<vtkActor*> Actors;
  int Chosen = 0;
};

}
