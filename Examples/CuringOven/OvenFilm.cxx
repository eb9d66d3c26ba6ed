// SPDX-License-Identifier: BSD-3-Clause
#include "OvenFilm.h"

#include "CureTable.h"
#include "Oven.h"
#include "VtkErrors.h"

#include <vtkActor.h>
#include <vtkBillboardTextActor3D.h>
#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkCompositeDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkFeatureEdges.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkOggTheoraWriter.h>
#include <vtkPNGWriter.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>
#include <vtkScalarBarActor.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace curingoven
{
namespace
{

// Like glowing violet glass: dark to light.
void SetIrradianceColors(vtkColorTransferFunction* colors, double most)
{
  const double stops[][3] = { { 0.01, 0.01, 0.04 }, { 0.15, 0.07, 0.35 }, { 0.38, 0.16, 0.62 },
    { 0.62, 0.36, 0.86 }, { 0.83, 0.68, 0.97 }, { 1, 1, 1 } };
  for (int i = 0; i < 6; ++i)
  {
    colors->AddRGBPoint(most * i * i / 25.0, stops[i][0], stops[i][1], stops[i][2]);
  }
}

// Blue where it is under-cured, red where it is over-cured; a jump at each limit.
void SetDoseColors(vtkColorTransferFunction* colors, double least, double most)
{
  const double jump = 1e-6 * most;
  colors->AddRGBPoint(0, 0.05, 0.08, 0.35);
  colors->AddRGBPoint(least - jump, 0.45, 0.70, 1.00);
  colors->AddRGBPoint(least, 0.05, 0.40, 0.25);
  colors->AddRGBPoint((least + most) / 2, 0.45, 0.72, 0.25);
  colors->AddRGBPoint(most, 0.98, 0.95, 0.55);
  colors->AddRGBPoint(most + jump, 1.00, 0.50, 0.15);
  colors->AddRGBPoint(1.5 * most, 0.60, 0.00, 0.08);
}

vtkNew<vtkTextProperty> TextStyle(int size)
{
  vtkNew<vtkTextProperty> style;
  style->SetColor(0.9, 0.9, 0.9);
  style->SetFontSize(size);
  return style;
}

int FontSize(int width)
{
  return std::max(9, width / 80);
}

void AddText(vtkRenderer* renderer, const std::string& text, double x, double y, int fontSize)
{
  vtkNew<vtkTextActor> actor;
  actor->SetInput(text.c_str());
  actor->SetTextProperty(TextStyle(fontSize));
  actor->GetTextProperty()->SetJustificationToCentered();
  actor->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  actor->SetPosition(x, y);
  renderer->AddViewProp(actor);
}

// In three rows: the colours, numbers below them, and the title. VTK's own numbers stand on the
// colours, if there is little space. Lengths are shares of the picture.
void AddLegend(vtkRenderer* renderer, vtkColorTransferFunction* colors, const char* title,
  std::initializer_list<double> labels, double left, int fontSize, double row)
{
  constexpr double width = 0.42;
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(colors);
  bar->SetMaximumNumberOfColors(256);
  bar->DrawTickLabelsOff();
  bar->SetOrientationToHorizontal();
  bar->SetBarRatio(1);
  bar->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  bar->SetPosition(left, 2.3 * row);
  bar->SetWidth(width);
  bar->SetHeight(row);
  renderer->AddViewProp(bar);
  const double* range = colors->GetRange();
  for (const double label : labels)
  {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", label);
    AddText(renderer, text, left + width * (label - range[0]) / (range[1] - range[0]), 1.35 * row,
      fontSize);
  }
  AddText(renderer, title, left + width / 2, 0.35 * row, fontSize);
}

vtkSmartPointer<vtkActor> MakeActor(vtkPolyDataMapper* mapper)
{
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  return actor;
}

// Each cell in the colour of its value.
vtkSmartPointer<vtkPolyDataMapper> MakeMapper(vtkColorTransferFunction* colors, const char* array)
{
  auto mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
  mapper->SetLookupTable(colors);
  mapper->UseLookupTableScalarRangeOn();
  mapper->SetScalarModeToUseCellFieldData();
  mapper->SelectColorArray(array);
  return mapper;
}

// Without shading, shapes show by their edges.
vtkSmartPointer<vtkActor> MakeEdges(vtkPolyData* mesh)
{
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputData(mesh);
  edges->SetFeatureAngle(25);
  edges->ColoringOff();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(edges->GetOutputPort());
  mapper->ScalarVisibilityOff();
  auto actor = MakeActor(mapper);
  actor->GetProperty()->SetColor(0, 0, 0);
  return actor;
}

// A cell array in thousands of its unit.
vtkSmartPointer<vtkDoubleArray> Kilo(vtkDataArray* values, const char* name)
{
  auto kilo = vtkSmartPointer<vtkDoubleArray>::New();
  kilo->SetName(name);
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    kilo->InsertNextValue(values->GetTuple1(i) / 1e3);
  }
  return kilo;
}

}

OvenFilm::OvenFilm(const OvenOptions& options)
  : Options(options)
{
  if (!options.Pictures)
  {
    return;
  }
  SetDoseColors(this->DoseColors, options.LeastDose / 1e3, options.MostDose / 1e3);
  this->Window->SetOffScreenRendering(1);
  this->Window->SetMultiSamples(0);
  this->Window->SetSize(options.Width, options.Height);
  this->SetUpRide();
  this->Window->AddRenderer(this->Ride);
  this->Window->Render(); // a display that cannot be used shows now, not after the first shooting
  this->Movie->SetFileName((options.Output + "/CuringOven.ogv").c_str());
  this->Movie->SetRate(15); // frames per second
  this->Movie->SetQuality(2);
}

OvenFilm::~OvenFilm()
{
  if (this->Movie->GetInput())
  {
    this->Movie->End();
  }
}

void OvenFilm::SetUpRide()
{
  // About what a lamp gives to the belt below it; the belt ends in white.
  const double pitch = 0.3;
  const double bright = this->Options.LampPower / (pitch * this->Options.OvenWidth) / 1e3;
  SetIrradianceColors(this->IrradianceColors, bright);
  const int fontSize = FontSize(this->Options.Width);
  const double row = 1.4 * fontSize / this->Options.Height;
  AddLegend(this->Ride, this->IrradianceColors, "Irradiance of the oven (kW/m2)",
    { 0, bright / 2, bright }, 0.04, fontSize, row);
  const double least = this->Options.LeastDose / 1e3, most = this->Options.MostDose / 1e3;
  AddLegend(this->Ride, this->DoseColors, "Dose of the parts so far (kJ/m2)",
    { 0, least, most, 1.5 * most }, 0.54, fontSize, row);
  this->Caption->SetTextProperty(TextStyle(fontSize));
  this->Caption->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  this->Caption->SetPosition(0.02, 1 - 1.2 * row);
  this->Ride->AddViewProp(this->Caption);
  this->Ride->SetBackground(0.10, 0.10, 0.12);
  // From the front and above, so far away that the tunnel fills the width.
  const double size = BeltEnd(this->Options) / 2;
  vtkCamera* camera = this->Ride->GetActiveCamera();
  camera->SetPosition(0.5 * size, -4.4 * size, 1.6 * size);
  camera->SetFocalPoint(0, 0, this->Options.OvenHeight / 2);
  camera->SetViewUp(0, 0, 1);
  camera->UseHorizontalViewAngleOn();
  camera->SetViewAngle(44);
  camera->SetWindowCenter(0, -3 * row); // leaves a margin to the legends
}

// What a part has received until now, by the trapezoidal rule.
void OvenFilm::AddDose(int part, double seconds, vtkPolyData* mesh)
{
  vtkDataArray* irradiance = mesh->GetCellData()->GetArray("Irradiance");
  vtkSmartPointer<vtkDoubleArray>& dose = this->Doses[part];
  if (!dose)
  {
    dose = Kilo(irradiance, "Dose");
    dose->FillValue(0);
  }
  vtkDataArray* last = this->LastIrradiances[part];
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    const double sum = irradiance->GetTuple1(i) + (last ? last->GetTuple1(i) : 0);
    dose->SetValue(i, dose->GetValue(i) + seconds * sum / 2 / 1e3);
  }
  dose->Modified();
  mesh->GetCellData()->AddArray(dose);
}

void OvenFilm::Show(std::size_t mesh, vtkPolyData* shown)
{
  if (mesh == this->Mappers.size())
  {
    const bool isPart = mesh >= NumberOfOvenMeshes;
    this->Mappers.push_back(
      isPart ? MakeMapper(this->DoseColors, "Dose") : MakeMapper(this->IrradianceColors, "Kilo"));
    const auto actor = MakeActor(this->Mappers.back());
    actor->GetMapper()->SetScalarVisibility(mesh != Lamps);
    actor->GetProperty()->SetBackfaceCulling(mesh == Tunnel);      // opens what one looks through
    actor->GetProperty()->SetFrontfaceCulling(mesh == Reflectors); // their backs
    this->Ride->AddActor(actor);
  }
  this->Mappers[mesh]->SetInputData(shown);
}

void OvenFilm::AddFrame(int step, double time, vtkMultiBlockDataSet* scene)
{
  if (!this->Options.Pictures)
  {
    return;
  }
  std::size_t number = 0;
  for (vtkPolyData* mesh : vtkCompositeDataSet::GetDataSets<vtkPolyData>(scene))
  {
    vtkNew<vtkPolyData> shown;
    shown->ShallowCopy(mesh);
    if (number < NumberOfOvenMeshes)
    {
      shown->GetCellData()->AddArray(Kilo(mesh->GetCellData()->GetArray("Irradiance"), "Kilo"));
    }
    else
    {
      const std::size_t part = number - NumberOfOvenMeshes;
      this->Doses.resize(std::max(this->Doses.size(), part + 1));
      this->LastIrradiances.resize(this->Doses.size());
      if (mesh->GetNumberOfCells() > 0)
      {
        this->AddDose(int(part), time - this->LastTime, shown);
        this->LastIrradiances[part] = mesh->GetCellData()->GetArray("Irradiance");
      }
    }
    this->Show(number++, shown);
  }
  this->LastTime = time;
  char caption[80];
  std::snprintf(caption, sizeof caption, "%.1f s", time);
  this->Caption->SetInput(caption);
  this->Ride->ResetCameraClippingRange();
  const bool isMiddle = step == this->Options.Steps / 2;
  this->Write(this->Ride, isMiddle ? this->Options.Output + "/CuringOven.png" : "");
}

void OvenFilm::WriteParts(vtkMultiBlockDataSet* scene, const std::vector<Part>& parts)
{
  if (!this->Options.Pictures)
  {
    return;
  }
  // Two rows of parts take more height than the oven.
  const int fontSize = FontSize(this->Options.Width);
  const int size[2] = { this->Options.Width, this->Options.Width / 2 };
  this->Window->SetSize(size[0], size[1]);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(0.10, 0.10, 0.12);
  const std::vector<vtkPolyData*> meshes = PartsOf(scene);
  double width = 0;
  for (const Part& part : parts)
  {
    width = std::max(width, 1.15 * part.Mesh->GetLength());
  }
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    vtkNew<vtkPolyData> shown; // as it is in its own frame
    shown->CopyStructure(parts[i].Mesh);
    shown->GetCellData()->AddArray(
      Kilo(meshes[i]->GetCellData()->GetArray("RadiantExposure"), "Dose"));
    const auto mapper = MakeMapper(this->DoseColors, "Dose");
    mapper->SetInputData(shown);
    const double x = width * (i - (parts.size() - 1) / 2.0);
    vtkNew<vtkBillboardTextActor3D> name;
    name->SetInput(parts[i].Name.c_str());
    name->SetPosition(x, 0, -1.07 * width);
    name->SetTextProperty(TextStyle(fontSize * 5 / 4));
    name->GetTextProperty()->SetJustificationToCentered();
    renderer->AddActor(name);
    for (const double row : { 0.5, -0.5 }) // from above; below that, from below
    {
      for (const auto& actor : { MakeActor(mapper), MakeEdges(shown) })
      {
        double b[6];
        shown->GetBounds(b);
        actor->SetOrigin((b[0] + b[1]) / 2, (b[2] + b[3]) / 2, (b[4] + b[5]) / 2);
        actor->SetOrientation(row > 0 ? 35 : -35, 0, 0);
        actor->RotateZ(row > 0 ? 25 : -25);
        actor->SetPosition(x - (b[0] + b[1]) / 2, 0, width * row - (b[4] + b[5]) / 2);
        renderer->AddActor(actor);
      }
    }
  }
  const double least = this->Options.LeastDose / 1e3, most = this->Options.MostDose / 1e3;
  AddLegend(renderer, this->DoseColors, "Dose (kJ/m2): blue under-cured, red over-cured",
    { 0, least, most, 1.5 * most }, 0.29, fontSize, 1.4 * fontSize / size[1]);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(0, -10, 0);
  camera->SetFocalPoint(0, 0, 0);
  camera->SetViewUp(0, 0, 1);
  camera->ParallelProjectionOn();
  renderer->ResetCameraClippingRange();
  camera->SetParallelScale(width * std::max(1.25, 0.5 * parts.size() * size[1] / size[0]));
  camera->SetWindowCenter(0, -0.12); // leaves a margin to the legend
  this->Write(renderer, this->Options.Output + "/Parts.png");
}

// As a picture; what shows the ride goes into the movie too.
void OvenFilm::Write(vtkRenderer* renderer, const std::string& file)
{
  this->Window->GetRenderers()->RemoveAllItems();
  this->Window->AddRenderer(renderer);
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(this->Window);
  picture->ReadFrontBufferOff();
  const movingteapot::VtkErrors errors;
  if (!file.empty())
  {
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputConnection(picture->GetOutputPort());
    writer->SetFileName(file.c_str());
    writer->Write();
    errors.ThrowIfAny("--output: " + file + " cannot be written");
  }
  if (renderer == this->Ride.Get())
  {
    const bool isFirst = !this->Movie->GetInput();
    this->Movie->SetInputConnection(picture->GetOutputPort());
    if (isFirst)
    {
      this->Movie->Start();
    }
    this->Movie->Write();
    errors.ThrowIfAny(
      std::string("--output: ") + this->Movie->GetFileName() + " cannot be written");
  }
}

}
