// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkButtonWidget.h>
#include <vtkNew.h>
#include <vtkScalarBarActor.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <functional>
#include <string>

class vtkLookupTable;
class vtkRenderer;
class vtkRenderWindow;
class vtkRenderWindowInteractor;

namespace interactiveroom
{

/** What lies over the picture: figures, keys, the colour bar, and a check box for the stale light. */
class Overlay
{
public:
  Overlay(vtkRenderer* renderer, vtkRenderWindowInteractor* interactor, vtkLookupTable* colors);

  void SetFigures(const std::string& lines);

  bool IsStaleShown() const { return this->StaleShown; }
  void ShowStale(bool isShown);

  /** `onSwitched` is called when the check box was clicked. */
  void OnSwitched(const std::function<void()>& onSwitched) { this->Switched = onSwitched; }

private:
  void AddText(vtkTextActor* text, vtkRenderer* renderer, double x, double y);
  void AddColorBar(vtkRenderer* renderer, vtkLookupTable* colors);
  void AddCheckBox(vtkRenderer* renderer, vtkRenderWindowInteractor* interactor);
  void PlaceCheckBox(vtkObject*, unsigned long, void*);
  void TakeStateOfButton(vtkObject*, unsigned long, void*);

  vtkRenderWindow* Window;
  vtkNew<vtkTextProperty> Style;
  vtkNew<vtkTextActor> Figures, Keys, CheckLabel;
  vtkNew<vtkScalarBarActor> Bar;
  vtkNew<vtkButtonWidget> Button;
  std::function<void()> Switched;
  bool StaleShown = false;
};

}
