// SPDX-License-Identifier: BSD-3-Clause
#include "ImageComparison.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkImageDifference.h"
#include "vtkNew.h"
#include "vtkPNGReader.h"
#include "vtkPNGWriter.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkUnsignedCharArray.h"
#include "vtkWindowToImageFilter.h"

#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cmath>
#include <iostream>

Picture::Picture(const std::array<double, 3>& cameraPosition, const std::array<double, 3>& focus)
  : Renderer(vtkSmartPointer<vtkRenderer>::New())
  , Window(vtkSmartPointer<vtkRenderWindow>::New())
{
  this->Window->SetMultiSamples(0);
  this->Window->SetOffScreenRendering(1);
  this->Window->SetSize(300, 300);
  this->Window->AddRenderer(this->Renderer);
  this->Renderer->SetBackground(0.2, 0.2, 0.3);
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  camera->SetPosition(cameraPosition.data());
  camera->SetFocalPoint(focus.data());
  camera->SetViewUp(0, 0, 1);
  camera->SetViewAngle(40);
}

namespace
{

/// A component of a cell array; grey arrays serve all bands.
double ValueOf(vtkDataArray* array, vtkIdType cell, int band)
{
  return array->GetComponent(cell, array->GetNumberOfComponents() == 3 ? band : 0);
}

/// Reflected and emitted, W/m2.
double RadiosityOf(vtkCellData* cells, vtkIdType cell, int band)
{
  vtkDataArray* exitance = cells->GetArray("RadiantExitance");
  return ValueOf(cells->GetArray("DiffuseReflectance"), cell, band) *
    ValueOf(cells->GetArray("Irradiance"), cell, band) +
    (exitance ? ValueOf(exitance, cell, band) : 0);
}

void Write(vtkAlgorithm* image, const std::string& name, bool isWanted)
{
  if (isWanted)
  {
    const std::string path = VTKIRRADIANCE_OUTPUT_DIR "/" + name + ".png";
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputConnection(image->GetOutputPort());
    writer->SetFileName(path.c_str());
    writer->Write();
    std::cout << "Look at " << path << "\n";
  }
}

}

void Picture::Add(vtkPolyData* polyData, double brightest)
{
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetName("Colours");
  colours->SetNumberOfComponents(3);
  colours->SetNumberOfTuples(polyData->GetNumberOfCells());
  for (vtkIdType cell = 0; cell < polyData->GetNumberOfCells(); ++cell)
  {
    for (int band = 0; band < 3; ++band)
    {
      const double part = RadiosityOf(polyData->GetCellData(), cell, band) / brightest;
      colours->SetComponent(cell, band, std::round(255 * std::sqrt(std::clamp(part, 0.0, 1.0))));
    }
  }
  vtkNew<vtkPolyData> shown;
  shown->CopyStructure(polyData);
  shown->GetCellData()->SetScalars(colours);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(shown);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->BackfaceCullingOn(); // shows rooms through their walls
  this->Renderer->AddActor(actor);
}

// vtkTesting's comparison does not serve: its vtkImageDifference forgives a difference of 105 (of
// 3 * 255) in every pixel, so a red wall passes for a green one.
bool Picture::IsSame(const std::string& name, bool isExpected)
{
  constexpr int forgivenOfAPixel = 16;
  constexpr double largestError = 10;

  this->Renderer->ResetCameraClippingRange();
  this->Window->Render();
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(this->Window);
  picture->ReadFrontBufferOff();
  picture->Update();
  const std::string baseline = VTKIRRADIANCE_BASELINE_DIR "/" + name + ".png";
  if (!vtksys::SystemTools::FileExists(baseline))
  {
    std::cout << "There is no " << baseline << "\n";
    Write(picture, name, isExpected);
    return false;
  }
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(baseline.c_str());
  vtkNew<vtkImageDifference> difference;
  difference->SetThreshold(forgivenOfAPixel);
  difference->SetInputConnection(picture->GetOutputPort());
  difference->SetImageConnection(reader->GetOutputPort());
  difference->Update();
  const double error = difference->GetThresholdedError();
  std::cout << name << ": error " << error << ", at most " << largestError << " pass\n";
  if (!(error <= largestError))
  {
    Write(picture, name, isExpected);
    Write(difference, name + ".difference", isExpected);
    return false;
  }
  return true;
}
