// SPDX-License-Identifier: BSD-3-Clause
#include "Picture.h"

#include "CellArea.h"
#include "Smoothing.h"
#include "TeapotScene.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkColorTransferFunction.h>
#include <vtkCompositeDataIterator.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace movingteapot
{
namespace
{

constexpr const char* Irradiance = "Irradiance"; // W/m2

// Dark to light like glowing iron; even steps in irradiance look even (the "inferno" map of
// matplotlib, CC0).
constexpr double ColorStops[][3] = { { 0.001, 0.000, 0.014 }, { 0.122, 0.047, 0.282 },
  { 0.341, 0.062, 0.429 }, { 0.550, 0.135, 0.404 }, { 0.736, 0.216, 0.330 },
  { 0.891, 0.350, 0.197 }, { 0.978, 0.558, 0.035 }, { 0.976, 0.793, 0.240 },
  { 0.988, 0.998, 0.645 } };

std::vector<vtkPolyData*> MeshesOf(vtkMultiBlockDataSet* scene)
{
  std::vector<vtkPolyData*> meshes;
  auto leaves = vtkSmartPointer<vtkCompositeDataIterator>::Take(scene->NewIterator());
  for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
  {
    meshes.push_back(vtkPolyData::SafeDownCast(leaves->GetCurrentDataObject()));
  }
  return meshes;
}

// The next value whose fifths are easily read.
double RoundUp(double value)
{
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (double step : { 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0 })
  {
    if (value <= step * power)
    {
      return step * power;
    }
  }
  return 10.0 * power;
}

struct LitArea
{
  double Irradiance; // W/m2
  double Area;       // m2
};

void AddCells(vtkPolyData* mesh, std::vector<LitArea>& cells)
{
  vtkDataArray* irradiance = mesh->GetCellData()->GetArray(Irradiance);
  for (vtkIdType i = 0; irradiance && i < mesh->GetNumberOfCells(); ++i)
  {
    cells.push_back({ irradiance->GetTuple1(i), CellArea(mesh, i) });
  }
}

// The end of the colour range: beyond 98 % of all area, so that the lamp's neighbourhood and a
// few noisy cells do not darken the rest.
double RangeOf(const std::vector<vtkPolyData*>& meshes)
{
  std::vector<LitArea> cells;
  double rest = 0.0;
  for (vtkPolyData* mesh : meshes)
  {
    AddCells(mesh, cells);
  }
  for (const LitArea& cell : cells)
  {
    rest += 0.02 * cell.Area;
  }
  std::sort(cells.begin(), cells.end(),
    [](const LitArea& a, const LitArea& b) { return a.Irradiance > b.Irradiance; });
  for (const LitArea& cell : cells)
  {
    rest -= cell.Area;
    if (rest <= 0.0 && cell.Irradiance > 0.0)
    {
      return RoundUp(cell.Irradiance);
    }
  }
  return 1.0;
}

}

bool HasDisplay()
{
#if defined(__unix__) && !defined(__APPLE__)
  const char* display = std::getenv("DISPLAY");
  return display && *display;
#else
  return true;
#endif
}

Picture::Picture(int width, int height, int smoothingPasses)
  : Height(height)
  , SmoothingPasses(smoothingPasses)
{
  this->Window->SetOffScreenRendering(1);
  this->Window->SetMultiSamples(0);
  this->Window->SetSize(width, height);
  this->Window->AddRenderer(this->Renderer);
  this->Renderer->SetBackground(1.0, 1.0, 1.0);
  this->Window->Render(); // a display that cannot be used shows now, not after the first shooting
}

Picture::~Picture() = default;

vtkSmartPointer<vtkImageData> Picture::Draw(vtkMultiBlockDataSet* scene, const std::string& caption)
{
  const std::vector<vtkPolyData*> meshes = MeshesOf(scene);
  if (this->Mappers.empty())
  {
    this->SetUp(meshes);
  }
  for (std::size_t i = 0; i < this->Mappers.size(); ++i)
  {
    vtkNew<vtkPolyData> shown;
    shown->ShallowCopy(meshes[i]);
    if (i > PlinthBlock) // what has no edges: smoothing does not stop at one
    {
      SmoothCellArray(shown, Irradiance, this->SmoothingPasses);
    }
    this->Mappers[i]->SetInputData(shown);
  }
  this->Caption->SetInput(caption.c_str());
  this->Window->Render();

  vtkNew<vtkWindowToImageFilter> grabber;
  grabber->SetInput(this->Window);
  grabber->ReadFrontBufferOff();
  grabber->Update();
  return grabber->GetOutput();
}

void Picture::SetUp(const std::vector<vtkPolyData*>& meshes)
{
  const double range = RangeOf(meshes);
  const int last = int(std::size(ColorStops)) - 1;
  for (int i = 0; i <= last; ++i)
  {
    const double* rgb = ColorStops[i];
    this->Colors->AddRGBPoint(range * i / last, rgb[0], rgb[1], rgb[2]);
  }
  for (std::size_t i = 0; i < meshes.size(); ++i)
  {
    this->AddActor(i == RoomBlock, i == LampBlock);
  }
  this->AddColorBar();
  this->AddCaption();
  this->PlaceCamera();
}

void Picture::AddActor(bool isRoom, bool isLamp)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetLookupTable(this->Colors);
  mapper->UseLookupTableScalarRangeOn();
  mapper->SetScalarModeToUseCellFieldData();
  mapper->SelectColorArray(Irradiance);
  mapper->SetScalarVisibility(!isLamp);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetBackfaceCulling(isRoom); // opens the wall one looks through
  this->Renderer->AddActor(actor);
  this->Mappers.push_back(mapper);
}

void Picture::AddColorBar()
{
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(this->Colors);
  bar->SetTitle("Irradiance (W/m2)");
  bar->SetNumberOfLabels(6);
  bar->SetMaximumNumberOfColors(256);
  bar->SetLabelFormat("  %-.4g");
  bar->SetVerticalTitleSeparation(this->Height / 60);
  bar->UnconstrainedFontSizeOn();
  for (vtkTextProperty* text : { bar->GetTitleTextProperty(), bar->GetLabelTextProperty() })
  {
    text->SetColor(0.1, 0.1, 0.1);
    text->SetFontSize(this->Height / 36);
    text->BoldOff();
    text->ItalicOff();
    text->ShadowOff();
  }
  bar->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  bar->SetPosition(0.85, 0.12);
  bar->SetWidth(0.13);
  bar->SetHeight(0.76);
  this->Renderer->AddViewProp(bar);
}

void Picture::AddCaption()
{
  vtkTextProperty* text = this->Caption->GetTextProperty();
  text->SetColor(0.1, 0.1, 0.1);
  text->SetFontSize(this->Height / 36);
  this->Caption->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  this->Caption->SetPosition(0.012, 0.02);
  this->Renderer->AddViewProp(this->Caption);
}

void Picture::PlaceCamera()
{
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  camera->SetFocalPoint(0.0, 0.0, 1.2);
  camera->SetPosition(0.0, -6.0, 1.2);
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetViewAngle(29.6);
  camera->SetWindowCenter(0.12, -0.03); // leaves margins to the colour bar and the caption
  this->Renderer->ResetCameraClippingRange();
}

}
