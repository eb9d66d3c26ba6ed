// SPDX-License-Identifier: BSD-3-Clause
#include "RoomWindow.h"

#include "CameraStyle.h"

#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkMath.h>

#include <cmath>
#include <cstdio>

namespace interactiveroom
{
namespace
{

constexpr double FiguresEach = 0.25; // s: to draw text takes time
constexpr double ProgressEach = 0.1; // s

// The next of 1, 1.5, 2, 3, 5, 7, 10 and so on.
double RoundUp(double value)
{
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (const double step : { 1.0, 1.5, 2.0, 3.0, 5.0, 7.0 })
  {
    if (value <= step * power)
    {
      return step * power;
    }
  }
  return 10 * power;
}

}

RoomWindow::RoomWindow(const Room& room, LightFollower& light, const RoomOptions& options)
  : TheRoom(room)
  , Light(light)
  , Brightest(options.Brightest)
  , Error(room)
{
  this->Window->SetWindowName("InteractiveRoom");
  this->Window->SetSize(options.Width, options.Height);
  this->Window->SetMultiSamples(0);
  this->Window->AddRenderer(this->Renderer);
  this->Renderer->SetBackground(0.11, 0.12, 0.15);
  this->Interactor->SetRenderWindow(this->Window);
  this->Interactor->SetInteractorStyle(vtkNew<CameraStyle>());
  this->Interactor->EnableRenderOff(); // a step renders
  this->View = std::make_unique<SceneView>(room, light, this->Renderer);
  this->Texts =
    std::make_unique<Overlay>(this->Renderer, this->Interactor, this->View->GetColors());
  this->SetUpCamera(room);
  this->Interactor->Initialize();
  this->Things =
    std::make_unique<DraggedThings>(room, light, *this->View, this->Renderer, this->Interactor);
  this->ObserveEvents();
}

void RoomWindow::SetUpCamera(const Room& room)
{
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  camera->SetPosition(room.Eye.data());
  camera->SetFocalPoint(room.Focus.data());
  camera->SetViewUp(0, 0, 1);
  camera->SetViewAngle(room.ViewAngle);
  camera->SetWindowCenter(0.1, 0.04); // leaves margins to the colour bar and the texts
  this->Renderer->ResetCameraClippingRange();
}

void RoomWindow::ObserveEvents()
{
  this->Interactor->AddObserver(vtkCommand::TimerEvent, this, &RoomWindow::StepByTimer);
  // Widgets and the camera's style ask for a render, which the interactor leaves to us.
  this->Interactor->AddObserver(vtkCommand::RenderEvent, this, &RoomWindow::NoteChange);
  this->Interactor->AddObserver(vtkCommand::KeyPressEvent, this, &RoomWindow::TakeKey);
  this->Texts->OnSwitched([this] { this->SwitchStale(this->Texts->IsStaleShown()); });
}

void RoomWindow::Shoot()
{
  auto shown = Clock::now();
  this->ShowProgress(0);
  this->Light.Shoot([&](double fraction) {
    const auto now = Clock::now();
    if (std::chrono::duration<double>(now - shown).count() > ProgressEach / 2)
    {
      this->ShowProgress(fraction);
      shown = Clock::now();
    }
  });
  if (this->Brightest == 0)
  {
    const double most = this->Error.Quantile(this->Light.GetScene(), 0.95);
    this->Brightest = most > 0 ? RoundUp(most) : 1;
  }
  this->View->SetBrightest(this->Brightest);
  this->Show();
}

void RoomWindow::ShowProgress(double fraction)
{
  char text[80];
  std::snprintf(text, sizeof text, "All walks are shot: %.0f %%", 100 * fraction);
  this->Texts->SetFigures(text);
  this->Window->Render();
}

void RoomWindow::AskForStep()
{
  if (!this->IsStepAsked)
  {
    this->IsStepAsked = true;
    this->Interactor->CreateOneShotTimer(1);
  }
}

void RoomWindow::StepByTimer(vtkObject*, unsigned long, void*)
{
  this->IsStepAsked = false;
  this->Step();
  if (!this->Light.IsExact())
  {
    this->AskForStep();
  }
}

void RoomWindow::Step()
{
  if (this->Light.IsExact())
  {
    this->Show();
    return;
  }
  const bool hasMoved = this->Light.HasMoved();
  this->Light.Step(hasMoved ? MovingSeconds : SettlingSeconds, [this] { this->Show(); });
  if (hasMoved)
  {
    this->Rate.Add();
  }
}

void RoomWindow::Settle()
{
  while (!this->Light.IsExact())
  {
    this->Step();
  }
  this->Show();
}

void RoomWindow::Show()
{
  this->View->Show(this->Light.GetScene(), this->Texts->IsStaleShown());
  const std::chrono::duration<double> old = Clock::now() - this->FiguresShown;
  if (old.count() > FiguresEach || this->Light.IsExact())
  {
    this->ShowFigures();
    this->FiguresShown = Clock::now();
  }
  this->Renderer->ResetCameraClippingRange();
  this->Window->Render();
  if (this->Rendered)
  {
    this->Rendered();
  }
}

void RoomWindow::ShowFigures()
{
  const double stale = this->Light.GetFilter()->GetFigure("StalePower");
  char text[240], rate[40] = "";
  if (this->IsFrameRateShown && this->Rate.Get() > 0)
  {
    std::snprintf(rate, sizeof rate, "%.0f frames a second\n", this->Rate.Get());
  }
  std::snprintf(text, sizeof text,
    "%s%s: %.3g of %.4g W stale\nstandard error of a cell: %.1f %% of the mean\nchosen: %s", rate,
    stale > 0 ? "settling" : "exact", stale, this->Light.GetFilter()->GetFigure("EmittedPower"),
    100 * this->Error.Of(this->Light.GetScene()),
    this->TheRoom.Moving[this->Things->GetChosen()].Name.c_str());
  this->Texts->SetFigures(text);
}

void RoomWindow::SwitchStale(bool isShown)
{
  this->Texts->ShowStale(isShown);
  this->AskForStep();
}

// Along the floor, as one looks: right is the axis nearest to the right of the picture.
void RoomWindow::MoveByKey(double right, double away)
{
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  const double* ahead = camera->GetDirectionOfProjection();
  const bool isAlongX = std::abs(ahead[0]) > std::abs(ahead[1]);
  const double sign = (isAlongX ? ahead[0] : ahead[1]) < 0 ? -1 : 1;
  const double x = sign * (isAlongX ? away : right), y = sign * (isAlongX ? -right : away);
  this->Things->Move(x, y, 0);
}

void RoomWindow::TakeKey(vtkObject*, unsigned long, void*)
{
  const std::string key = this->Interactor->GetKeySym() ? this->Interactor->GetKeySym() : "";
  const double way = 0.01 * this->Renderer->GetActiveCamera()->GetDistance(), angle = 5;
  const std::pair<const char*, std::function<void()>> actions[] = {
    { "Right", [&] { this->MoveByKey(way, 0); } },
    { "Left", [&] { this->MoveByKey(-way, 0); } },
    { "Up", [&] { this->MoveByKey(0, way); } },
    { "Down", [&] { this->MoveByKey(0, -way); } },
    { "Prior", [&] { this->Things->Move(0, 0, way); } },
    { "Next", [&] { this->Things->Move(0, 0, -way); } },
    { "comma", [&] { this->Things->Turn(angle); } },
    { "period", [&] { this->Things->Turn(-angle); } },
    { "Tab", [&] { this->Things->ChooseNext(); } },
    { "r", [&] { this->Things->Reset(); } },
    { "s", [&] { this->SwitchStale(!this->Texts->IsStaleShown()); } },
  };
  for (const auto& [name, act] : actions)
  {
    if (key == name)
    {
      act();
    }
  }
}

}
