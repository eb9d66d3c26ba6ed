// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "DraggedThings.h"
#include "FrameRate.h"
#include "LightFollower.h"
#include "MeanError.h"
#include "Overlay.h"
#include "RoomOptions.h"
#include "SceneView.h"

#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

#include <chrono>
#include <functional>
#include <memory>

namespace interactiveroom
{

/**
 * The window. What mouse and keys do only changes poses and the camera, and asks for a step by a
 * timer; the step brings the light up to date and renders once. So a step takes in all events
 * before it, and none waits longer than a step takes.
 */
class RoomWindow
{
public:
  /** What a step and its picture may take: while things move, and while the light settles. */
  static constexpr double MovingSeconds = 0.03, SettlingSeconds = 0.07;

  RoomWindow(const Room& room, LightFollower& light, const RoomOptions& options);

  /** Shoots all walks; the window shows how far it is. */
  void Shoot();

  /** Until the user closes the window. */
  void Run() { this->Interactor->Start(); }

  /** Brings the light up to date, as far as there is time, and renders. */
  void Step();

  /** Until the light is exact and shown. */
  void Settle();

  /** Called after each render. */
  void OnRendered(const std::function<void()>& onRendered) { this->Rendered = onRendered; }

  /** Frames a second are no figure of a played file: its pictures are the same on each machine. */
  void HideFrameRate() { this->IsFrameRateShown = false; }

  vtkRenderWindow* GetWindow() { return this->Window; }
  vtkRenderWindowInteractor* GetInteractor() { return this->Interactor; }
  DraggedThings& GetThings() { return *this->Things; }

private:
  void SetUpCamera(const Room& room);
  void ObserveEvents();
  void AskForStep();
  void StepByTimer(vtkObject*, unsigned long, void*);
  void NoteChange(vtkObject*, unsigned long, void*) { this->AskForStep(); }
  void TakeKey(vtkObject*, unsigned long, void*);
  void MoveByKey(double right, double away);
  void SwitchStale(bool isShown);
  void ShowProgress(double fraction);
  void Show();
  void ShowFigures();

  using Clock = std::chrono::steady_clock;

  const Room& TheRoom;
  LightFollower& Light;
  double Brightest; // W/m2; 0: not known yet
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkRenderWindowInteractor> Interactor;
  MeanError Error;
  std::unique_ptr<SceneView> View;
  std::unique_ptr<Overlay> Texts;
  std::unique_ptr<DraggedThings> Things;
  FrameRate Rate;
  Clock::time_point FiguresShown; // when
  std::function<void()> Rendered;
  bool IsStepAsked = false;
  bool IsFrameRateShown = true;
};

}
