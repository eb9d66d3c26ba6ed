// SPDX-License-Identifier: BSD-3-Clause
#include "DraggedThings.h"

#include <vtkActor.h>
#include <vtkBoundingBox.h>
#include <vtkCommand.h>
#include <vtkEvent.h>
#include <vtkMatrix4x4.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkWidgetEvent.h>
#include <vtkWidgetEventTranslator.h>

#include <algorithm>

namespace interactiveroom
{
namespace
{

// The box around a mesh in its own frame, a little larger, so that no side is flat or hidden.
vtkBoundingBox BoxAround(vtkPolyData* mesh)
{
  double b[6];
  mesh->GetBounds(b);
  vtkBoundingBox box(b);
  box.Inflate(0.02 * box.GetDiagonalLength());
  return box;
}

// How far something has to move along an axis to be inside; if it is too large, to be in the
// middle.
double WayInside(const double own[2], const double limits[2])
{
  if (own[1] - own[0] > limits[1] - limits[0])
  {
    return (limits[0] + limits[1] - own[0] - own[1]) / 2;
  }
  return std::max(0.0, limits[0] - own[0]) + std::min(0.0, limits[1] - own[1]);
}

void MoveInside(vtkMatrix4x4* worldFromMesh, vtkPolyData* mesh, const movingteapot::Box& limits)
{
  vtkBoundingBox box;
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double x[4] = { 0, 0, 0, 1 };
    mesh->GetPoint(i, x);
    worldFromMesh->MultiplyPoint(x, x);
    box.AddPoint(x);
  }
  double own[6];
  box.GetBounds(own);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double way = WayInside(&own[2 * axis], &limits[2 * axis]);
    worldFromMesh->SetElement(axis, 3, worldFromMesh->GetElement(axis, 3) + way);
  }
}

// To move is what one does most: it needs no second key.
void SetMouseActions(vtkWidgetEventTranslator* translator)
{
  const auto set = [translator](unsigned long event, int modifier, unsigned long action) {
    translator->RemoveTranslation(event, modifier, 0, 0, nullptr);
    translator->SetTranslation(event, modifier, 0, 0, nullptr, action);
  };
  set(vtkCommand::LeftButtonPressEvent, vtkEvent::NoModifier, vtkWidgetEvent::Translate);
  set(vtkCommand::LeftButtonPressEvent, vtkEvent::ShiftModifier, vtkWidgetEvent::Select);
}

}

DraggedThings::DraggedThings(const Room& room, LightFollower& light, SceneView& view,
  vtkRenderer* renderer, vtkRenderWindowInteractor* interactor)
  : TheRoom(room)
  , Light(light)
  , Renderer(renderer)
  , Interactor(interactor)
{
  this->Picker->PickFromListOn();
  this->Picker->SetTolerance(0);
  for (int i = 0; i < int(room.Moving.size()); ++i)
  {
    this->Actors.push_back(view.GetActor(i));
    this->Picker->AddPickList(view.GetActor(i));
  }
  this->Box->SetPlaceFactor(1);
  this->Box->HandlesOff();
  this->Box->OutlineCursorWiresOff();
  this->Box->GetOutlineProperty()->SetColor(0.3, 0.8, 1);
  this->Box->GetSelectedOutlineProperty()->SetColor(0.5, 1, 0.5);
  // Lines have these colours however they lie: VTK 9.3 adds what lamps bring to some of them.
  this->Box->GetOutlineProperty()->SetDiffuse(0);
  this->Box->GetSelectedOutlineProperty()->SetDiffuse(0);
  this->Box->GetSelectedFaceProperty()->SetOpacity(0);
  this->Widget->SetInteractor(interactor);
  this->Widget->SetDefaultRenderer(renderer);
  this->Widget->SetRepresentation(this->Box);
  this->Widget->ScalingEnabledOff();
  this->Widget->MoveFacesEnabledOff();
  SetMouseActions(this->Widget->GetEventTranslator());
  this->Widget->AddObserver(vtkCommand::InteractionEvent, this, &DraggedThings::TakePoseOfBox);
  // Before the widget gets the press, its box is where the mouse is.
  const float first = this->Widget->GetPriority() + 0.1f;
  interactor->AddObserver(
    vtkCommand::LeftButtonPressEvent, this, &DraggedThings::ChooseUnderMouse, first);
  this->Choose(0);
  this->Widget->On();
}

void DraggedThings::Choose(int thing)
{
  this->Chosen = thing;
  double b[6];
  BoxAround(this->TheRoom.Moving[thing].Mesh).GetBounds(b);
  this->Box->PlaceWidget(b);
  this->PlaceBox();
}

void DraggedThings::ChooseNext()
{
  this->Choose((this->Chosen + 1) % int(this->TheRoom.Moving.size()));
}

void DraggedThings::PlaceBox()
{
  this->Box->SetTransform(this->Light.GetPose(this->Chosen));
  this->Interactor->Render();
}

void DraggedThings::ChooseUnderMouse(vtkObject*, unsigned long, void*)
{
  const int* at = this->Interactor->GetEventPosition();
  this->Picker->Pick(at[0], at[1], 0, this->Renderer);
  const auto found = std::find(this->Actors.begin(), this->Actors.end(), this->Picker->GetActor());
  const int thing = int(found - this->Actors.begin());
  if (found != this->Actors.end() && thing != this->Chosen)
  {
    this->Choose(thing);
  }
}

void DraggedThings::TakePoseOfBox(vtkObject*, unsigned long, void*)
{
  vtkNew<vtkTransform> worldFromMesh;
  this->Box->GetTransform(worldFromMesh);
  this->SetPose(worldFromMesh);
}

void DraggedThings::Move(double x, double y, double z)
{
  vtkNew<vtkTransform> worldFromMesh;
  worldFromMesh->Translate(x, y, z);
  worldFromMesh->Concatenate(this->Light.GetPose(this->Chosen)->GetMatrix());
  this->SetPose(worldFromMesh);
}

void DraggedThings::Turn(double angle)
{
  double middle[3];
  BoxAround(this->TheRoom.Moving[this->Chosen].Mesh).GetCenter(middle);
  vtkTransform* pose = this->Light.GetPose(this->Chosen);
  pose->TransformPoint(middle, middle);
  vtkNew<vtkTransform> worldFromMesh;
  worldFromMesh->Translate(middle);
  worldFromMesh->RotateZ(angle);
  worldFromMesh->Translate(-middle[0], -middle[1], -middle[2]);
  worldFromMesh->Concatenate(pose->GetMatrix());
  this->SetPose(worldFromMesh);
}

void DraggedThings::Reset()
{
  for (std::size_t i = 0; i < this->TheRoom.Moving.size(); ++i)
  {
    this->Light.GetPose(int(i))->SetMatrix(this->TheRoom.Moving[i].WorldFromMesh->GetMatrix());
  }
  this->PlaceBox();
}

void DraggedThings::SetPose(vtkTransform* worldFromMesh)
{
  vtkNew<vtkMatrix4x4> pose;
  pose->DeepCopy(worldFromMesh->GetMatrix());
  if (this->TheRoom.Limits)
  {
    MoveInside(pose, this->TheRoom.Moving[this->Chosen].Mesh, *this->TheRoom.Limits);
  }
  this->Light.GetPose(this->Chosen)->SetMatrix(pose);
  this->PlaceBox();
}

}
