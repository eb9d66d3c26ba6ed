// SPDX-License-Identifier: BSD-3-Clause
#include "Overlay.h"

#include <vtkCommand.h>
#include <vtkCoordinate.h>
#include <vtkImageCanvasSource2D.h>
#include <vtkImageData.h>
#include <vtkLookupTable.h>
#include <vtkProperty2D.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkTexturedButtonRepresentation2D.h>

#include <algorithm>

namespace interactiveroom
{
namespace
{

// A frame, filled or not.
vtkSmartPointer<vtkImageData> MakeCheckBox(bool isChecked)
{
  constexpr int side = 32, frame = 3, gap = 9; // pixels
  vtkNew<vtkImageCanvasSource2D> canvas;
  canvas->SetScalarTypeToUnsignedChar();
  canvas->SetNumberOfScalarComponents(3);
  canvas->SetExtent(0, side - 1, 0, side - 1, 0, 0);
  canvas->SetDrawColor(225, 225, 225);
  canvas->FillBox(0, side - 1, 0, side - 1);
  canvas->SetDrawColor(30, 33, 40);
  canvas->FillBox(frame, side - 1 - frame, frame, side - 1 - frame);
  if (isChecked)
  {
    canvas->SetDrawColor(250, 160, 20);
    canvas->FillBox(gap, side - 1 - gap, gap, side - 1 - gap);
  }
  canvas->Update();
  return canvas->GetOutput();
}

}

Overlay::Overlay(
  vtkRenderer* renderer, vtkRenderWindowInteractor* interactor, vtkLookupTable* colors)
  : Window(renderer->GetRenderWindow())
{
  const int height = this->Window->GetSize()[1];
  this->Style->SetColor(0.9, 0.9, 0.9);
  this->Style->SetFontSize(std::max(10, height / 36));
  this->Style->SetVerticalJustificationToTop();
  this->AddText(this->Figures, renderer, 0.012, 0.98);
  this->AddText(this->Keys, renderer, 0.012, 0.02);
  this->Keys->GetTextProperty()->SetVerticalJustificationToBottom();
  this->Keys->GetTextProperty()->SetFontSize(std::max(8, height / 46));
  this->Keys->SetInput("drag: move    Shift + drag: turn    arrows, Page Up, Page Down: move    "
                       ", and .: turn    Tab: the next thing\n"
                       "s: stale light    r: all things back    beside things: turn the view    "
                       "wheel: nearer, farther    q: quit");
  this->AddColorBar(renderer, colors);
  this->AddCheckBox(renderer, interactor);
  this->ShowStale(false);
}

void Overlay::AddText(vtkTextActor* text, vtkRenderer* renderer, double x, double y)
{
  text->GetTextProperty()->ShallowCopy(this->Style);
  text->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  text->SetPosition(x, y);
  renderer->AddViewProp(text);
}

void Overlay::AddColorBar(vtkRenderer* renderer, vtkLookupTable* colors)
{
  this->Bar->SetLookupTable(colors);
  this->Bar->SetNumberOfLabels(6);
  this->Bar->SetMaximumNumberOfColors(256);
  this->Bar->SetLabelFormat("  %-.4g");
  this->Bar->SetVerticalTitleSeparation(this->Style->GetFontSize() * 3 / 5);
  this->Bar->UnconstrainedFontSizeOn();
  this->Bar->SetTitleTextProperty(this->Style);
  this->Bar->SetLabelTextProperty(this->Style);
  this->Bar->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  this->Bar->SetPosition(0.84, 0.17);
  this->Bar->SetWidth(0.145);
  this->Bar->SetHeight(0.72);
  renderer->AddViewProp(this->Bar);
}

void Overlay::AddCheckBox(vtkRenderer* renderer, vtkRenderWindowInteractor* interactor)
{
  vtkNew<vtkTexturedButtonRepresentation2D> box;
  box->SetNumberOfStates(2);
  box->SetButtonTexture(0, MakeCheckBox(false));
  box->SetButtonTexture(1, MakeCheckBox(true));
  box->SetPlaceFactor(1);
  box->GetHoveringProperty()->SetColor(1, 1, 1);
  box->GetSelectingProperty()->SetColor(1, 1, 1);
  this->Button->SetInteractor(interactor);
  this->Button->SetDefaultRenderer(renderer);
  this->Button->SetRepresentation(box);
  this->Button->On();
  this->Button->AddObserver(vtkCommand::StateChangedEvent, this, &Overlay::TakeStateOfButton);
  this->CheckLabel->SetInput("stale light");
  this->AddText(this->CheckLabel, renderer, 0, 0);
  this->PlaceCheckBox(nullptr, 0, nullptr);
  this->Window->AddObserver(vtkCommand::WindowResizeEvent, this, &Overlay::PlaceCheckBox);
}

// Below the colour bar. The box has a place in pixels, which depends on the size of the window.
void Overlay::PlaceCheckBox(vtkObject*, unsigned long, void*)
{
  const int* size = this->Window->GetSize();
  const double side = 1.2 * this->Style->GetFontSize(); // pixels
  const double left = 0.86 * size[0], bottom = 0.1 * size[1];
  double place[6] = { left, left + side, bottom, bottom + side, 0, 0 };
  this->Button->GetRepresentation()->PlaceWidget(place);
  this->CheckLabel->SetPosition(0.86 + 1.4 * side / size[0], 0.1 + side / size[1]);
}

void Overlay::SetFigures(const std::string& lines)
{
  this->Figures->SetInput(lines.c_str());
}

void Overlay::ShowStale(bool isShown)
{
  this->StaleShown = isShown;
  this->Bar->SetTitle(isShown ? "Stale (W/m2)" : "Irradiance (W/m2)");
  vtkTexturedButtonRepresentation2D::SafeDownCast(this->Button->GetRepresentation())
    ->SetState(isShown);
}

void Overlay::TakeStateOfButton(vtkObject*, unsigned long, void*)
{
  this->ShowStale(!this->StaleShown);
  if (this->Switched)
  {
    this->Switched();
  }
}

}
