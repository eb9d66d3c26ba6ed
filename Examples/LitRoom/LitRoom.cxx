// SPDX-License-Identifier: BSD-3-Clause
// The whole of vtkIrradiance in ten minutes: a room with a lamp, and a ball that moves through it.
// Prints the light on the room, and leaves in the folder LitRoom-output irradiance.vtm,
// ParaViewState.py, which opens it in ParaView, and the picture irradiance.png.
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkColorTransferFunction.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIrradianceFilter.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPlaneSource.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkSphereSource.h>
#include <vtkStringArray.h>
#include <vtkTessellatedBoxSource.h>
#include <vtkTextProperty.h>
#include <vtkTransform.h>
#include <vtkWindowToImageFilter.h>
#include <vtkXMLMultiBlockDataWriter.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <vector>

namespace
{

// What the block of a mesh is called in the output; without a name it is "Static 0" or the like.
void SetName(vtkPolyData* mesh, const char* name)
{
  vtkNew<vtkStringArray> array;
  array->SetName("Name");
  array->InsertNextValue(name);
  mesh->GetFieldData()->AddArray(array);
}

// 98 % of all cells receive at most this, W/m2. The few brightest shall not darken the picture.
double MostOf(const std::vector<vtkPolyData*>& meshes)
{
  std::vector<double> values;
  for (vtkPolyData* mesh : meshes)
  {
    vtkDataArray* irradiance = mesh->GetCellData()->GetArray("Irradiance");
    for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
    {
      values.push_back(irradiance->GetTuple1(cell));
    }
  }
  std::sort(values.begin(), values.end());
  return values[values.size() * 98 / 100];
}

// Looks into the room through its front wall, in the colours of the array; VTK's own lights are
// off.
void WritePicture(vtkMultiBlockDataSet* scene, const char* file)
{
  const auto meshes = vtkCompositeDataSet::GetDataSets<vtkPolyData>(scene); // room, lamp, ball
  vtkNew<vtkColorTransferFunction> colours;                                 // as glowing iron
  const double most = MostOf(meshes);
  colours->AddRGBPoint(0, 0, 0, 0.02);
  colours->AddRGBPoint(most / 4, 0.34, 0.06, 0.43);
  colours->AddRGBPoint(most / 2, 0.74, 0.22, 0.33);
  colours->AddRGBPoint(most * 3 / 4, 0.98, 0.56, 0.04);
  colours->AddRGBPoint(most, 0.99, 1, 0.65);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(0.15, 0.15, 0.17);
  for (vtkPolyData* mesh : meshes)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(mesh);
    mapper->SetScalarModeToUseCellFieldData();
    mapper->SelectColorArray("Irradiance");
    mapper->SetLookupTable(colours);
    mapper->UseLookupTableScalarRangeOn();
    mapper->SetScalarVisibility(mesh != meshes[1]); // the lamp is white
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->LightingOff();
    actor->GetProperty()->SetFrontfaceCulling(mesh == meshes[0]); // the outside of the room
    renderer->AddActor(actor);
  }
  vtkNew<vtkScalarBarActor> legend;
  legend->SetLookupTable(colours);
  legend->SetTitle("Irradiance (W/m2)");
  legend->SetLabelFormat("  %-.3g");
  legend->SetMaximumNumberOfColors(256);
  legend->UnconstrainedFontSizeOn();
  legend->GetTitleTextProperty()->SetFontSize(14);
  legend->SetVerticalTitleSeparation(12);
  legend->SetPosition(0.865, 0.1);
  legend->SetWidth(0.12);
  legend->SetHeight(0.8);
  renderer->AddViewProp(legend);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetViewUp(0, 0, 1);
  camera->SetPosition(0, -8.5, 1.5);
  camera->SetFocalPoint(0, 0, 1.5);
  camera->SetViewAngle(28);
  camera->SetWindowCenter(0.16, 0); // leaves a margin to the legend
  renderer->ResetCameraClippingRange();

  vtkNew<vtkRenderWindow> window;
  window->OffScreenRenderingOn();
  window->SetSize(1000, 680);
  window->AddRenderer(renderer);
  vtkNew<vtkWindowToImageFilter> grabber;
  grabber->SetInput(window);
  vtkNew<vtkPNGWriter> picture;
  picture->SetInputConnection(grabber->GetOutputPort());
  picture->SetFileName(file);
  picture->Write();
}

}

int main(int argc, char*[])
{
  if (argc > 1)
  {
    std::cout << "LitRoom: the light in a room through which a ball moves. It has no options.\n\n"
                 "Results: ./LitRoom-output: irradiance.vtm, ParaViewState.py, irradiance.png\n";
    return 0;
  }

  // The room: 4 x 4 x 3 m, cut into cells, because every cell gets one value. Cells have two sides
  // and we look at the inner ones. Without an array "DiffuseReflectance" they reflect half the
  // light.
  vtkNew<vtkTessellatedBoxSource> room;
  room->SetBounds(-2, 2, -2, 2, 0, 3);
  room->SetLevel(30);
  room->QuadsOn();
  room->Update();
  SetName(room->GetOutput(), "room");

  // The lamp: two metres square, below the ceiling. Any cell with a "RadiantExitance" shines, from
  // its front: the side from which its points run counter-clockwise.
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-1, -1, 2.9);
  plane->SetPoint1(-1, 1, 2.9);
  plane->SetPoint2(1, -1, 2.9);
  plane->Update();
  vtkPolyData* lamp = plane->GetOutput();
  vtkNew<vtkDoubleArray> exitance;
  exitance->SetName("RadiantExitance");
  exitance->InsertNextValue(100); // W/m2
  lamp->GetCellData()->AddArray(exitance);
  SetName(lamp, "lamp");

  // The ball stays the same in its own coordinates; a transform places it in the world.
  vtkNew<vtkSphereSource> ball;
  ball->SetThetaResolution(32);
  ball->SetPhiResolution(32);
  ball->Update();
  SetName(ball->GetOutput(), "ball");
  vtkNew<vtkTransform> worldFromBall;
  worldFromBall->Translate(-1, 0, 0.7);

  vtkNew<vtkIrradianceFilter> irradiance;
  irradiance->AddInputConnection(0, room->GetOutputPort()); // what stays: walls, lamps
  irradiance->AddInputDataObject(0, lamp);                  // cell array "RadiantExitance", W/m2
  irradiance->AddInputConnection(1, ball->GetOutputPort()); // what moves, in model coordinates
  irradiance->SetDynamicTransform(0, worldFromBall);
  irradiance
    ->SetMethodToGatheredEverywhere(); // not only small cells look for indirect light: no grain

  // The first update shoots a million photon walks. The others shoot again only what the ball has
  // changed; their result is the same, bit for bit, as if all were shot again.
  for (int frame = 0; frame < 8; ++frame)
  {
    worldFromBall->Translate(0.1, 0, 0);
    irradiance->Update(); // repairs what the motion touched

    auto* output = irradiance->GetOutput(); // "Static", "Dynamic": cell array "Irradiance"

    // Both blocks hold a polydata for each connection. Field data of the whole say how it went.
    vtkPolyData* lit = vtkCompositeDataSet::GetDataSets<vtkPolyData>(output).at(0); // the room
    double range[2];
    lit->GetCellData()->GetArray("Irradiance")->GetRange(range);
    vtkFieldData* report = output->GetFieldData();
    std::cout << "Irradiance " << range[0] << " to " << range[1] << " W/m2; "
              << report->GetArray("NumberOfRepairedSegments")->GetTuple1(0) << " of "
              << report->GetArray("NumberOfSegments")->GetTuple1(0) << " segments shot again\n";
  }

  // For ParaView: the last frame with all its arrays, and how to look at it.
  namespace fs = std::filesystem;
  fs::create_directory("LitRoom-output");
  fs::remove("LitRoom-output/irradiance.png"); // of an earlier run
  vtkNew<vtkXMLMultiBlockDataWriter> writer;
  writer->SetInputConnection(irradiance->GetOutputPort());
  writer->SetFileName("LitRoom-output/irradiance.vtm");
  writer->SetDataModeToBinary(); // Debian's ParaView cannot read the default, appended data
  writer->Write();
  std::ofstream("LitRoom-output/ParaViewState.py")
    << "FOLDER = " << fs::absolute("LitRoom-output") << '\n'
    << std::ifstream(LITROOM_STATE).rdbuf();

  // Where VTK draws by X it ends the program if there is no display.
  const char* display = std::getenv("DISPLAY");
  if (vtkNew<vtkRenderWindow>()->IsA("vtkXOpenGLRenderWindow") && !(display && *display))
  {
    std::cerr << "No picture: DISPLAY is not set, and VTK needs an X display (xvfb-run is one).\n";
    return 0;
  }
  WritePicture(irradiance->GetOutput(), "LitRoom-output/irradiance.png");
  return 0;
}
