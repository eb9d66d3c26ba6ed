// SPDX-License-Identifier: BSD-3-Clause
#include "Recording.h"

#include "IrradianceColors.h"
#include "OutputFolder.h"
#include "TeapotScene.h"
#include "VtkErrors.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellDataToPointData.h>
#include <vtkColorTransferFunction.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkOggTheoraWriter.h>
#include <vtkPNGWriter.h>
#include <vtkPointDataToCellData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkWindowToImageFilter.h>
#include <vtkXMLMultiBlockDataWriter.h>
#include <vtksys/SystemTools.hxx>

#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace movingteapot
{
namespace
{

void MakeFolder(const std::string& path)
{
  if (!vtksys::SystemTools::MakeDirectory(path))
  {
    throw std::runtime_error(path + ": this folder cannot be made");
  }
}

// MovingTeapot_0007.extension for frame 7: sorts by name as by time.
std::string FrameFile(int frame, const char* extension)
{
  char name[40];
  std::snprintf(name, sizeof name, "MovingTeapot_%04d.%s", frame, extension);
  return name;
}

constexpr const char* Irradiance = "Irradiance"; // W/m2

// The end of the colour range, W/m2. With the lamp of this scene 98 % of all area receive less; the
// lamp's neighbourhood does not darken the rest.
constexpr double Brightest = 30.0;

// Each point takes the mean of the cells around it, and each cell then the mean of its points:
// small cells, which few photons hit, become less noisy.
vtkSmartPointer<vtkPolyData> Smooth(vtkPolyData* mesh, int passes)
{
  vtkSmartPointer<vtkPolyData> smooth = mesh;
  for (int pass = 0; pass < passes; ++pass)
  {
    vtkNew<vtkCellDataToPointData> toPoints;
    toPoints->SetInputData(smooth);
    vtkNew<vtkPointDataToCellData> toCells;
    toCells->SetInputConnection(toPoints->GetOutputPort());
    toCells->Update();
    smooth = toCells->GetPolyDataOutput();
  }
  return smooth;
}

vtkNew<vtkScalarBarActor> MakeColorBar(vtkColorTransferFunction* colors, vtkTextProperty* style)
{
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(colors);
  bar->SetTitle("Irradiance (W/m2)");
  bar->SetNumberOfLabels(6);
  bar->SetMaximumNumberOfColors(256);
  bar->SetLabelFormat("  %-.4g");
  bar->SetVerticalTitleSeparation(style->GetFontSize() * 3 / 5);
  bar->UnconstrainedFontSizeOn();
  bar->SetTitleTextProperty(style);
  bar->SetLabelTextProperty(style);
  bar->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  bar->SetPosition(0.85, 0.12);
  bar->SetWidth(0.13);
  bar->SetHeight(0.76);
  return bar;
}

}

Recording::Recording(const Options& options)
  : Folder(options.Output + "/")
  , Pictures(options.Pictures)
  , Smoothings(options.GatherRays > 0 ? 0 : options.Smoothings)
{
  PrepareFolder(options.Output,
    R"((MovingTeapot\.(pvd|ogv)|ParaViewState\.py|pictures(/MovingTeapot_\d{4,}\.png)?)"
    R"(|MovingTeapot(/MovingTeapot_\d{4,}(\.vtm|(/MovingTeapot_\d{4,}_\d+\.vtp)?))?))");
  AddParaViewState(options.Output);
  MakeFolder(this->Folder + "MovingTeapot");
  if (this->Pictures)
  {
    MakeFolder(this->Folder + "pictures");
    this->SetUpWindow(options.Width, options.Height);
    this->Movie->SetFileName((this->Folder + "MovingTeapot.ogv").c_str());
    this->Movie->SetRate(15); // frames per second
    this->Movie->SetQuality(2);
  }
}

Recording::~Recording()
{
  if (this->Movie->GetInput())
  {
    this->Movie->End();
  }
}

void Recording::Add(int frame, double time, vtkMultiBlockDataSet* scene, const std::string& caption)
{
  this->AddToSeries(frame, time, scene);
  if (this->Pictures)
  {
    this->AddPicture(frame, scene, caption);
  }
}

void Recording::AddToSeries(int frame, double time, vtkMultiBlockDataSet* scene)
{
  const std::string file = "MovingTeapot/" + FrameFile(frame, "vtm");
  const VtkErrors errors;
  vtkNew<vtkXMLMultiBlockDataWriter> writer;
  writer->SetFileName((this->Folder + file).c_str());
  writer->SetDataModeToBinary(); // Debian's ParaView cannot read appended data
  writer->SetInputData(scene);
  writer->Write();
  errors.ThrowIfAny(this->Folder + file + " cannot be written");

  // The list with the times is ParaView's own; VTK has no writer for it.
  this->DataSets +=
    "    <DataSet timestep=\"" + std::to_string(time) + "\" part=\"0\" file=\"" + file + "\"/>\n";
  std::ofstream list(this->Folder + "MovingTeapot.pvd");
  list << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n"
       << this->DataSets << "  </Collection>\n</VTKFile>\n";
  if (!list.flush())
  {
    throw std::runtime_error(this->Folder + "MovingTeapot.pvd cannot be written");
  }
}

void Recording::SetUpWindow(int width, int height)
{
  vtkNew<vtkTextProperty> style;
  style->SetColor(0.1, 0.1, 0.1);
  style->SetFontSize(height / 36);
  SetIrradianceColors(this->Colors, Brightest);
  this->Caption->SetTextProperty(style);
  this->Caption->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  this->Caption->SetPosition(0.012, 0.02);
  this->Renderer->AddViewProp(this->Caption);
  this->Renderer->AddViewProp(MakeColorBar(this->Colors, style));
  this->Renderer->SetBackground(1.0, 1.0, 1.0);
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  camera->SetFocalPoint(0.0, 0.0, 1.2);
  camera->SetPosition(0.0, -6.0, 1.2);
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetViewAngle(29.6);
  camera->SetWindowCenter(0.12, -0.03); // leaves margins to the colour bar and the caption

  this->Window->SetOffScreenRendering(1);
  this->Window->SetMultiSamples(0);
  this->Window->SetSize(width, height);
  this->Window->AddRenderer(this->Renderer);
  this->Window->Render(); // a display that cannot be used shows now, not after the first shooting
}

void Recording::AddActor(bool isRoom, bool isLamp)
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

void Recording::AddPicture(int frame, vtkMultiBlockDataSet* scene, const std::string& caption)
{
  int block = 0;
  for (vtkPolyData* mesh : vtkCompositeDataSet::GetDataSets<vtkPolyData>(scene))
  {
    if (block == int(this->Mappers.size()))
    {
      this->AddActor(block == RoomBlock, block == LampBlock);
    }
    // What has no edges is smoothed: smoothing does not stop at one.
    this->Mappers[block]->SetInputData(
      block > PlinthBlock ? Smooth(mesh, this->Smoothings).Get() : mesh);
    ++block;
  }
  this->Caption->SetInput(caption.c_str());
  this->Renderer->ResetCameraClippingRange();

  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(this->Window);
  picture->ReadFrontBufferOff();
  const std::string file = this->Folder + "pictures/" + FrameFile(frame, "png");
  const VtkErrors errors;
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->SetFileName(file.c_str());
  writer->Write();
  errors.ThrowIfAny(file + " cannot be written");

  this->Movie->SetInputConnection(picture->GetOutputPort());
  if (frame == 0)
  {
    this->Movie->Start();
  }
  this->Movie->Write();
  errors.ThrowIfAny(std::string(this->Movie->GetFileName()) + " cannot be written");
}

}
