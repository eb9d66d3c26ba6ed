// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What the tests of the window share.
#include "../../Testing/FiltersIrradiance/TestScenes.h"
#include "../../Testing/WriteFile.h"
#include "LightFollower.h"
#include "RoomOptions.h"
#include "RoomPresets.h"
#include "RoomWindow.h"

#include <vtkWindowToImageFilter.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

namespace interactiveroom
{

/** A preset in its window, with the light of its first poses. */
struct Shown
{
  explicit Shown(const std::vector<std::string>& words)
    : Options(ReadOptions(words))
    , TheRoom(MakePreset(Options.Preset))
    , Light(TheRoom, Options.Walks, Options.GatherRays)
    , Window(TheRoom, Light, Options)
  {
    this->Window.HideFrameRate();
    this->Window.Shoot();
  }

  void Send(
    unsigned long event, int x, int y, bool isShift = false, char code = 0, const char* key = "0")
  {
    vtkRenderWindowInteractor* interactor = this->Window.GetInteractor();
    interactor->SetEventInformation(x, y, 0, isShift, code, 0, key);
    interactor->InvokeEvent(event, nullptr);
  }

  void Drag(int fromX, int fromY, int toX, int toY, bool isShift = false)
  {
    this->Send(vtkCommand::MouseMoveEvent, fromX, fromY, isShift);
    this->Send(vtkCommand::LeftButtonPressEvent, fromX, fromY, isShift);
    this->Send(vtkCommand::MouseMoveEvent, toX, toY, isShift);
    this->Send(vtkCommand::LeftButtonReleaseEvent, toX, toY, isShift);
  }

  void Press(const char* key, char code = 0)
  {
    this->Send(vtkCommand::KeyPressEvent, 0, 0, false, code, key);
  }
  void Release(const char* key, char code = 0)
  {
    this->Send(vtkCommand::KeyReleaseEvent, 0, 0, false, code, key);
  }

  /** Where a thing is. */
  vtkMatrix4x4* Pose(int thing) { return this->Light.GetPose(thing)->GetMatrix(); }
  TestScenes::Vector Place(int thing)
  {
    return { this->Pose(thing)->GetElement(0, 3), this->Pose(thing)->GetElement(1, 3),
      this->Pose(thing)->GetElement(2, 3) };
  }
  TestScenes::Vector MiddleOf(int thing)
  {
    TestScenes::Vector middle;
    this->TheRoom.Moving[thing].Mesh->GetCenter(middle.data());
    this->Light.GetPose(thing)->TransformPoint(middle.data(), middle.data());
    return middle;
  }

  RoomOptions Options;
  Room TheRoom;
  LightFollower Light;
  RoomWindow Window;
};

/** Of the preset "room". */
enum Things
{
  Teapot,
  Ball,
  Crate,
  Drum,
  Ring,
  NumberOfThings
};

inline bool IsEqual(vtkMatrix4x4* a, vtkMatrix4x4* b)
{
  return std::equal(a->GetData(), a->GetData() + 16, b->GetData());
}

inline vtkSmartPointer<vtkImageData> PictureOf(Shown& shown)
{
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(shown.Window.GetWindow());
  picture->ReadFrontBufferOff();
  picture->ShouldRerenderOff();
  picture->Update();
  return picture->GetOutput();
}

}
