// SPDX-License-Identifier: BSD-3-Clause
// Glossy objects: a copper teapot flies through a room, before a mirror, and the camera moves as
// well. Leaves the movie GlossyRoom.ogv and a picture of each frame, and compares the last frame
// with a fresh start.
#include "CommandLine.h"
#include "Meshes.h"
#include "OutputFolder.h"
#include "ProgressBar.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkCellDataToPointData.h>
#include <vtkCompositeDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkIrradianceFilter.h>
#include <vtkMath.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkOggTheoraWriter.h>
#include <vtkOutgoingRadianceFilter.h>
#include <vtkPNGWriter.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTransform.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>
#include <vtksys/SystemTools.hxx>

#include <array>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using Mesh = vtkSmartPointer<vtkPolyData>;
using Colour = std::array<double, 3>; // a value for each band

constexpr const char* Results = "GlossyRoom.ogv, pictures/";

struct Options
{
  int Walks;
  int Frames;
  int Samples;
  int Width, Height; // pixels
  std::string Output;
  bool Help = false;
};

std::vector<movingteapot::Option> OptionsOf(Options& o)
{
  using namespace movingteapot;
  return {
    { "--walks", "N", "1000000", "photon walks", Count(o.Walks, 1) },
    { "--frames", "N", "60", "frames, the first one included", Count(o.Frames, 1) },
    { "--samples", "N", "64", "rays of a glossy cell; half of them gather", Count(o.Samples, 1) },
    { "--size", "WxH", "960x720", "size of the pictures in pixels", Size(o.Width, o.Height) },
    { "--output", "FOLDER", "./GlossyRoom-output", "where all results go", Text(o.Output) },
    { "--help", "", "", "this text", Switch(o.Help, true) },
  };
}

// The same for all cells.
void SetCells(vtkPolyData* mesh, const char* name, const Colour& value)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    array->InsertNextTuple(value.data());
  }
  mesh->GetCellData()->AddArray(array);
}

// Diffuse and specular reflectance add up to at most 1 in each band.
void SetGloss(vtkPolyData* mesh, const Colour& diffuse, const Colour& specular, double exponent)
{
  SetCells(mesh, "DiffuseReflectance", diffuse);
  SetCells(mesh, "SpecularReflectance", specular);
  vtkNew<vtkDoubleArray> exponents;
  exponents->SetName("PhongExponent"); // infinite: a mirror
  exponents->SetNumberOfTuples(mesh->GetNumberOfCells());
  exponents->FillValue(exponent);
  mesh->GetCellData()->AddArray(exponents);
}

Mesh MakeRectangle(const Colour& origin, const Colour& point1, const Colour& point2, int cells)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(origin[0], origin[1], origin[2]);
  plane->SetPoint1(point1[0], point1[1], point1[2]);
  plane->SetPoint2(point2[0], point2[1], point2[2]);
  plane->SetResolution(cells, cells);
  plane->Update();
  return plane->GetOutput();
}

// The meshes of the scene, in the order in which they come out again.
enum MeshNumber
{
  Room,
  Lamp,
  Mirror,
  Teapot
};

void MakeScene(vtkIrradianceFilter* light, vtkTransform* worldFromTeapot, const Options& options)
{
  const Mesh room = movingteapot::MakeGridBox({ -2, 2, -2.5, 1.5, 0, 2.5 }, 0.125,
    movingteapot::Facing::Inward, { { 0.5, 0.5, 0.5, 0.5, 0.5, 0.5 } });
  // One wall is red, the floor is polished wood.
  SetCells(room, "DiffuseReflectance", { 0.7, 0.7, 0.7 });
  SetCells(room, "SpecularReflectance", { 0, 0, 0 });
  vtkNew<vtkDoubleArray> exponents;
  exponents->SetName("PhongExponent");
  exponents->SetNumberOfTuples(room->GetNumberOfCells());
  exponents->FillValue(40);
  room->GetCellData()->AddArray(exponents);
  for (vtkIdType i = 0; i < room->GetNumberOfCells(); ++i)
  {
    double bounds[6];
    room->GetCellBounds(i, bounds);
    if (bounds[1] < -1.999)
    {
      room->GetCellData()->GetArray("DiffuseReflectance")->SetTuple3(i, 0.65, 0.12, 0.1);
    }
    if (bounds[5] < 1e-6)
    {
      room->GetCellData()->GetArray("DiffuseReflectance")->SetTuple3(i, 0.4, 0.26, 0.15);
      room->GetCellData()->GetArray("SpecularReflectance")->SetTuple3(i, 0.2, 0.2, 0.2);
    }
  }
  const Mesh lamp =
    MakeRectangle({ -0.6, -0.9, 2.48 }, { -0.6, 0.1, 2.48 }, { 0.6, -0.9, 2.48 }, 1);
  SetCells(lamp, "RadiantExitance", { 22, 20, 17 }); // W/m2
  const Mesh mirror = MakeRectangle({ -1, 1.45, 0.3 }, { 1.7, 1.45, 0.3 }, { -1, 1.45, 2.1 }, 128);
  SetGloss(mirror, { 0, 0, 0 }, { 0.9, 0.9, 0.9 }, vtkMath::Inf());
  const Mesh teapot =
    movingteapot::FitMesh(movingteapot::MakeUtahTeapot(12), { -0.7, 0.7, -0.7, 0.7, -0.35, 0.65 });
  SetGloss(teapot, { 0.15, 0.08, 0.05 }, { 0.75, 0.48, 0.34 }, 12);
  for (vtkPolyData* still : { room.Get(), lamp.Get(), mirror.Get() })
  {
    light->AddInputDataObject(0, still);
  }
  light->AddInputDataObject(1, teapot);
  light->SetDynamicTransform(0, worldFromTeapot);
  light->SetMethodToGathered(); // the teapot's cells are small
  light->SetNumberOfRays((options.Samples + 1) / 2);
  light->SeparateSidesOn(); // an eye sees one side
}

/** Where everything is at a time from 0 to 1. */
void Place(double time, vtkTransform* worldFromTeapot, vtkCamera* camera)
{
  worldFromTeapot->Identity();
  worldFromTeapot->Translate(
    -0.9 + 1.6 * time, 0.3, 0.9 + 0.2 * std::sin(2 * vtkMath::Pi() * time));
  worldFromTeapot->RotateZ(90 * time);
  worldFromTeapot->RotateY(20);
  camera->SetPosition(1 - 1.6 * time, -2.2, 1.6);
  camera->SetFocalPoint(0.1, 0.8, 1.05);
  camera->SetViewUp(0, 0, 1);
  camera->SetViewAngle(55);
}

/** The colours of radiances, for a screen: 1 - exp(-exposure * L), then a gamma of 2.2. */
void AddColours(vtkDataSetAttributes* data)
{
  constexpr double exposure = 1.3; // m2 sr/W
  vtkDataArray* radiance = data->GetArray("Radiance");
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetName("Colour");
  colours->SetNumberOfComponents(3);
  colours->SetNumberOfTuples(radiance->GetNumberOfTuples());
  for (vtkIdType i = 0; i < radiance->GetNumberOfTuples(); ++i)
  {
    for (int band = 0; band < 3; ++band)
    {
      const double shown = 1 - std::exp(-exposure * radiance->GetComponent(i, band));
      colours->SetComponent(i, band, std::round(255 * std::pow(shown, 1 / 2.2)));
    }
  }
  data->AddArray(colours);
}

class Pictures
{
public:
  explicit Pictures(const Options& options)
    : Folder(options.Output + "/")
  {
    movingteapot::PrepareFolder(
      options.Output, R"(GlossyRoom\.ogv|pictures(/GlossyRoom_\d{4,}\.png)?)");
    if (!this->IsDrawn)
    {
      return;
    }
    if (!vtksys::SystemTools::MakeDirectory(this->Folder + "pictures"))
    {
      throw std::runtime_error(this->Folder + "pictures: this folder cannot be made");
    }
    this->Window->SetOffScreenRendering(1);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(options.Width, options.Height);
    this->Window->AddRenderer(this->Renderer);
    this->Movie->SetFileName((this->Folder + "GlossyRoom.ogv").c_str());
    this->Movie->SetRate(15);
  }
  ~Pictures()
  {
    if (this->Movie->GetInput())
    {
      this->Movie->End();
    }
  }

  bool AreDrawn() const { return this->IsDrawn; }

  vtkCamera* GetCamera() { return this->Renderer->GetActiveCamera(); }

  void Add(int frame, vtkMultiBlockDataSet* scene)
  {
    if (!this->IsDrawn)
    {
      return;
    }
    int number = 0;
    for (vtkPolyData* mesh : vtkCompositeDataSet::GetDataSets<vtkPolyData>(scene))
    {
      this->Show(mesh, number++);
    }
    this->Renderer->ResetCameraClippingRange();
    vtkNew<vtkWindowToImageFilter> picture;
    picture->SetInput(this->Window);
    picture->ReadFrontBufferOff();
    char name[40];
    std::snprintf(name, sizeof name, "pictures/GlossyRoom_%04d.png", frame);
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputConnection(picture->GetOutputPort());
    writer->SetFileName((this->Folder + name).c_str());
    writer->Write();
    this->Movie->SetInputConnection(picture->GetOutputPort());
    if (frame == 0)
    {
      this->Movie->Start();
    }
    this->Movie->Write();
  }

private:
  // Cells as they are; only the teapot is shaded smoothly.
  void Show(vtkPolyData* mesh, int number)
  {
    Mesh shown = mesh;
    if (number == Teapot)
    {
      vtkNew<vtkCellDataToPointData> toPoints;
      toPoints->SetInputData(mesh);
      toPoints->Update();
      shown = vtkPolyData::SafeDownCast(toPoints->GetOutput());
    }
    AddColours(number == Teapot ? static_cast<vtkDataSetAttributes*>(shown->GetPointData())
                                : shown->GetCellData());
    vtkSmartPointer<vtkPolyDataMapper>& mapper = this->Mappers[number];
    if (!mapper)
    {
      mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
      number == Teapot ? mapper->SetScalarModeToUsePointFieldData()
                       : mapper->SetScalarModeToUseCellFieldData();
      mapper->SelectColorArray("Colour");
      mapper->SetColorModeToDirectScalars();
      vtkNew<vtkActor> actor;
      actor->SetMapper(mapper);
      actor->GetProperty()->LightingOff();
      this->Renderer->AddActor(actor);
    }
    mapper->SetInputData(shown);
  }

  std::string Folder;
  const bool IsDrawn = movingteapot::CanDraw();
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkOggTheoraWriter> Movie;
  std::map<int, vtkSmartPointer<vtkPolyDataMapper>> Mappers;
};

bool IsSame(vtkMultiBlockDataSet* a, vtkMultiBlockDataSet* b)
{
  const auto left = vtkCompositeDataSet::GetDataSets<vtkPolyData>(a);
  const auto right = vtkCompositeDataSet::GetDataSets<vtkPolyData>(b);
  bool isSame = left.size() == right.size() && !left.empty();
  for (std::size_t i = 0; isSame && i < left.size(); ++i)
  {
    auto* x = vtkDoubleArray::SafeDownCast(left[i]->GetCellData()->GetArray("Radiance"));
    auto* y = vtkDoubleArray::SafeDownCast(right[i]->GetCellData()->GetArray("Radiance"));
    isSame = x && y && x->GetNumberOfValues() == y->GetNumberOfValues() &&
      std::equal(x->GetPointer(0), x->GetPointer(0) + x->GetNumberOfValues(), y->GetPointer(0));
  }
  return isSame;
}

void Run(const Options& options)
{
  Pictures pictures(options);
  vtkNew<vtkTransform> worldFromTeapot;
  vtkNew<vtkIrradianceFilter> light;
  light->SetNumberOfWalks(options.Walks);
  MakeScene(light, worldFromTeapot, options);
  vtkNew<vtkOutgoingRadianceFilter> radiance;
  radiance->SetInputConnection(light->GetOutputPort());
  radiance->SetCamera(pictures.GetCamera());
  radiance->SetNumberOfSpecularSamples(options.Samples);
  movingteapot::ProgressBar progress(options.Frames + 1);
  for (int frame = 0; frame < options.Frames; ++frame)
  {
    progress.BeginStep(1, "frame " + std::to_string(frame));
    Place(double(frame) / options.Frames, worldFromTeapot, pictures.GetCamera());
    radiance->Update(); // repairs the walks that the teapot touched, then looks at all cells
    pictures.Add(frame, radiance->GetOutput());
  }
  progress.BeginStep(1, "comparing with a fresh start");
  vtkNew<vtkIrradianceFilter> fresh;
  fresh->SetNumberOfWalks(options.Walks);
  MakeScene(fresh, worldFromTeapot, options);
  vtkNew<vtkOutgoingRadianceFilter> freshRadiance;
  freshRadiance->SetInputConnection(fresh->GetOutputPort());
  freshRadiance->SetCamera(pictures.GetCamera());
  freshRadiance->SetNumberOfSpecularSamples(options.Samples);
  freshRadiance->Update();
  progress.Finish();
  if (!IsSame(radiance->GetOutput(), freshRadiance->GetOutput()))
  {
    throw std::runtime_error("the radiance of the last frame differs from a fresh start's");
  }
  std::cout << "The radiance of the last frame equals a fresh start's, bit for bit.\n"
            << "Written to " << options.Output << ": "
            << (pictures.AreDrawn() ? Results : "nothing") << "\n";
}

}

int main(int argc, char* argv[])
{
  try
  {
    Options options;
    movingteapot::ReadCommandLine(OptionsOf(options), { argv + 1, argv + argc });
    if (options.Help)
    {
      std::cout << movingteapot::ComposeHelp(
        "GlossyRoom: a copper teapot before a mirror, as an eye sees it.", OptionsOf(options), "",
        Results);
    }
    else
    {
      Run(options);
    }
    return 0;
  }
  catch (const std::exception& error)
  {
    std::cerr << "GlossyRoom: " << error.what() << "\n";
    return 1;
  }
}
