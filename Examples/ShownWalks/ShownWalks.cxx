// SPDX-License-Identifier: BSD-3-Clause
// The method at work: photon walks in a room in which a teapot moves. What the motion made the
// filter shoot again stands out. Leaves in the folder ShownWalks-output the picture ShownWalks.png.
#include "CommandLine.h"
#include "Meshes.h"
#include "OutputFolder.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellDataToPointData.h>
#include <vtkCompositePolyDataMapper.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkImageShrink3D.h>
#include <vtkIrradianceFilter.h>
#include <vtkLegendBoxActor.h>
#include <vtkLookupTable.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPhotonWalksFilter.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTextProperty.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>
#include <vtkTubeFilter.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using Mesh = vtkSmartPointer<vtkPolyData>;

constexpr double Kept[3] = { 0.45, 0.62, 0.85 };
constexpr double ShotAgain[3] = { 1, 0.42, 0.08 };

Mesh MakeLamp()
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-0.5, -0.4, 2.45);
  plane->SetPoint1(-0.5, 0.4, 2.45);
  plane->SetPoint2(0.5, -0.4, 2.45);
  plane->Update();
  vtkNew<vtkDoubleArray> exitance;
  exitance->SetName("RadiantExitance");
  exitance->InsertNextValue(100); // W/m2
  Mesh lamp = plane->GetOutput();
  lamp->GetCellData()->AddArray(exitance);
  return lamp;
}

/** A walk may be kept up to a hit and shot again from there on: the point array tells. */
struct Segments
{
  explicit Segments(vtkPolyData* walks)
  {
    vtkDataArray* repaired = walks->GetPointData()->GetArray("Repaired");
    vtkNew<vtkCellArray> kept, shotAgain;
    vtkNew<vtkIdList> ids;
    for (vtkIdType walk = 0; walk < walks->GetNumberOfCells(); ++walk)
    {
      walks->GetCellPoints(walk, ids);
      for (vtkIdType i = 1; i < ids->GetNumberOfIds(); ++i)
      {
        const vtkIdType ends[2] = { ids->GetId(i - 1), ids->GetId(i) };
        (repaired->GetTuple1(ends[1]) == 0 ? kept : shotAgain)->InsertNextCell(2, ends);
      }
    }
    this->Kept->SetPoints(walks->GetPoints());
    this->Kept->SetLines(kept);
    this->ShotAgain->SetPoints(walks->GetPoints());
    this->ShotAgain->SetLines(shotAgain);
  }

  vtkNew<vtkPolyData> Kept, ShotAgain;
};

class Picture
{
public:
  Picture()
  {
    this->Renderer->SetBackground(0.02, 0.02, 0.03);
    this->Renderer->SetUseDepthPeeling(1);
    this->Renderer->SetMaximumNumberOfPeels(32);
    this->Window->SetAlphaBitPlanes(1);
    this->Window->OffScreenRenderingOn();
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(1920, 1280); // Write() averages 2 x 2 pixels;
    this->Window->AddRenderer(this->Renderer);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetViewUp(0, 0, 1);
    camera->SetPosition(0.9, -6.4, 1.15);
    camera->SetFocalPoint(0, 0, 1.2);
    camera->SetViewAngle(33);
  }

  /** The light as a dim backdrop. One looks in through the walls in front, as they face away. */
  void AddScene(vtkMultiBlockDataSet* light)
  {
    vtkNew<vtkLookupTable> greys;
    greys->SetHueRange(0.6, 0.6);
    greys->SetSaturationRange(0.25, 0.1);
    greys->SetValueRange(0.03, 0.75);
    greys->SetRampToLinear();
    greys->SetTableRange(0, 10); // W/m2
    vtkNew<vtkCellDataToPointData> smooth;
    smooth->SetInputDataObject(light);
    vtkNew<vtkCompositePolyDataMapper> mapper;
    mapper->SetInputConnection(smooth->GetOutputPort());
    mapper->SetScalarModeToUsePointFieldData();
    mapper->SelectColorArray("Irradiance");
    mapper->SetLookupTable(greys);
    mapper->UseLookupTableScalarRangeOn();
    vtkProperty* property = this->Add(mapper);
    property->LightingOff();
    property->BackfaceCullingOn();
  }

  vtkProperty* AddMesh(vtkPolyData* mesh, double red, double green, double blue)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(mesh);
    mapper->ScalarVisibilityOff();
    mapper->SetResolveCoincidentTopologyToPolygonOffset();
    mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(-2, -2);
    vtkProperty* property = this->Add(mapper);
    property->SetColor(red, green, blue);
    return property;
  }

  vtkProperty* AddTubes(vtkPolyData* lines, const double colour[3], double radius)
  {
    vtkNew<vtkTubeFilter> tubes;
    tubes->SetInputData(lines);
    tubes->SetRadius(radius);
    tubes->SetNumberOfSides(12);
    tubes->CappingOn();
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(tubes->GetOutputPort());
    mapper->ScalarVisibilityOff();
    vtkProperty* property = this->Add(mapper);
    property->SetColor(colour[0], colour[1], colour[2]);
    property->SetAmbient(0.45);
    property->SetDiffuse(0.6);
    return property;
  }

  void AddLegend(const std::string& kept, const std::string& shotAgain)
  {
    vtkNew<vtkPlaneSource> swatch;
    swatch->Update();
    vtkNew<vtkLegendBoxActor> legend;
    legend->SetNumberOfEntries(2);
    double colours[2][3];
    std::copy_n(Kept, 3, colours[0]);
    std::copy_n(ShotAgain, 3, colours[1]);
    legend->SetEntry(0, swatch->GetOutput(), kept.c_str(), colours[0]);
    legend->SetEntry(1, swatch->GetOutput(), shotAgain.c_str(), colours[1]);
    legend->GetPositionCoordinate()->SetValue(0.015, 0.015);
    legend->GetPosition2Coordinate()->SetValue(0.3, 0.075);
    legend->BorderOff();
    legend->GetEntryTextProperty()->SetColor(0.9, 0.9, 0.9);
    this->Renderer->AddViewProp(legend);
  }

  void Write(const std::string& file)
  {
    this->Renderer->ResetCameraClippingRange();
    vtkNew<vtkWindowToImageFilter> grabber;
    grabber->SetInput(this->Window);
    grabber->ReadFrontBufferOff();
    vtkNew<vtkImageShrink3D> smooth;
    smooth->SetInputConnection(grabber->GetOutputPort());
    smooth->SetShrinkFactors(2, 2, 1);
    smooth->AveragingOn();
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputConnection(smooth->GetOutputPort());
    writer->SetFileName(file.c_str());
    writer->SetCompressionLevel(9);
    writer->Write();
    if (writer->GetErrorCode() != 0)
    {
      throw std::runtime_error(file + ": this file cannot be written");
    }
  }

private:
  vtkProperty* Add(vtkMapper* mapper)
  {
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    this->Renderer->AddActor(actor);
    return actor->GetProperty();
  }

  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
};

struct Options
{
  int Walks, Shown;
  std::string Output;
  bool Help = false;
};

std::vector<movingteapot::Option> OptionsOf(Options& o)
{
  using namespace movingteapot;
  return {
    { "--walks", "N", "1000000", "photon walks", Count(o.Walks, 1) },
    { "--shown", "N", "240", "of these, so many are shown", Count(o.Shown, 1) },
    { "--output", "FOLDER", "./ShownWalks-output", "where all results go", Text(o.Output) },
    { "--help", "", "", "this text", Switch(o.Help, true) },
  };
}

void Run(const Options& options)
{
  movingteapot::PrepareFolder(options.Output, R"(ShownWalks\.png)");
  const Mesh room = movingteapot::MakeGridBox({ -2, 2, -1.5, 1.5, 0, 2.5 }, 0.1,
    movingteapot::Facing::Inward, { { 0.6, 0.6, 0.6, 0.6, 0.6, 0.6 } });
  const Mesh lamp = MakeLamp();
  const Mesh teapot =
    movingteapot::FitMesh(movingteapot::MakeUtahTeapot(16), { -0.5, 0.5, -0.5, 0.5, 0, 0.6 });
  vtkNew<vtkTransform> worldFromTeapot;
  worldFromTeapot->Translate(-0.95, -0.1, 0.65);

  vtkNew<vtkIrradianceFilter> light;
  light->AddInputDataObject(0, room);
  light->AddInputDataObject(0, lamp);
  light->AddInputDataObject(1, teapot);
  light->SetDynamicTransform(0, worldFromTeapot);
  // Walks that begin at the lamp are easier to look at, and the teapot's cells are small.
  light->SetMethodToSpreadWalks();
  light->SetNumberOfWalks(options.Walks);
  vtkNew<vtkPhotonWalksFilter> shown;
  shown->SetInputConnection(light->GetOutputPort());
  shown->SetNumberOfWalks(options.Shown);
  shown->Update(); // shoots all walks
  vtkNew<vtkTransformPolyDataFilter> before;
  before->SetInputData(teapot);
  before->SetTransform(worldFromTeapot);
  before->Update();
  const Mesh ghost = before->GetOutput();

  worldFromTeapot->Translate(1.15, 0.15, 0.15);
  worldFromTeapot->RotateZ(-35);
  worldFromTeapot->RotateY(18);
  shown->Update(); // shoots again what the teapot touched, where it was or where it is

  vtkPolyData* walks = shown->GetOutput();
  vtkDataArray* repaired = walks->GetCellData()->GetArray("Repaired");
  vtkIdType count = 0;
  for (vtkIdType walk = 0; walk < walks->GetNumberOfCells(); ++walk)
  {
    count += repaired->GetTuple1(walk) != 0;
  }
  std::cout << count << " of the " << walks->GetNumberOfCells()
            << " walks shown were shot again, and "
            << light->GetOutput()->GetFieldData()->GetArray("NumberOfInvalidWalks")->GetTuple1(0)
            << " of all " << light->GetNumberOfWalks() << std::endl;

  if (!movingteapot::CanDraw())
  {
    return;
  }
  const Segments segments(walks);
  Picture picture;
  picture.AddScene(light->GetOutput());
  picture.AddMesh(lamp, 1, 0.95, 0.8)->LightingOff();
  picture.AddMesh(ghost, 0.8, 0.85, 0.9)->SetOpacity(0.2);
  picture.AddTubes(segments.Kept, Kept, 0.0032)->SetOpacity(0.2);
  picture.AddTubes(segments.ShotAgain, ShotAgain, 0.0075);
  picture.AddLegend("kept", "shot again");
  picture.Write(options.Output + "/ShownWalks.png");
  std::cout << "Written to " << options.Output << ": ShownWalks.png\n";
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
      std::cout << movingteapot::ComposeHelp("ShownWalks: which photon walks a motion touched.",
        OptionsOf(options), "", "ShownWalks.png");
    }
    else
    {
      Run(options);
    }
    return 0;
  }
  catch (const std::exception& error)
  {
    std::cerr << "ShownWalks: " << error.what() << "\n";
    return 1;
  }
}
