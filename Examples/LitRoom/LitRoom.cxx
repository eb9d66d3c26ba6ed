// SPDX-License-Identifier: BSD-3-Clause
// The whole of vtkIrradiance in ten minutes: a room with a lamp, and a ball that moves through it.
// Prints the light on the room, and leaves irradiance.vtm for ParaView and the picture irradiance.png.
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkCompositePolyDataMapper2.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIrradianceFilter.h>
#include <vtkLookupTable.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPlaneSource.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkSphereSource.h>
#include <vtkTessellatedBoxSource.h>
#include <vtkTransform.h>
#include <vtkWindowToImageFilter.h>
#include <vtkXMLMultiBlockDataWriter.h>

#include <iostream>

int main()
{
  // The room: 4 x 4 x 3 m, cut into cells, because every cell gets one value. Cells have two sides
  // and we look at the inner ones. Without an array "DiffuseReflectance" they reflect half the light.
  vtkNew<vtkTessellatedBoxSource> room;
  room->SetBounds(-2, 2, -2, 2, 0, 3);
  room->SetLevel(20);
  room->QuadsOn();

  // The lamp: a square metre below the ceiling. Any cell with a "RadiantExitance" shines, from its
  // front: the side from which its points run counter-clockwise.
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-0.5, -0.5, 2.9);
  plane->SetPoint1(-0.5, 0.5, 2.9);
  plane->SetPoint2(0.5, -0.5, 2.9);
  plane->Update();
  vtkPolyData* lamp = plane->GetOutput();
  vtkNew<vtkDoubleArray> exitance;
  exitance->SetName("RadiantExitance");
  exitance->InsertNextValue(100); // W/m2
  lamp->GetCellData()->AddArray(exitance);

  // The ball stays the same in its own coordinates; a transform places it in the world.
  vtkNew<vtkSphereSource> ball;
  ball->SetThetaResolution(32);
  ball->SetPhiResolution(32);
  vtkNew<vtkTransform> worldFromBall;
  worldFromBall->Translate(-1, 0, 0.8);

  vtkNew<vtkIrradianceFilter> irradiance;
  irradiance->AddInputConnection(0, room->GetOutputPort()); // what stays: walls, lamps
  irradiance->AddInputDataObject(0, lamp);                  // cell array "RadiantExitance", W/m2
  irradiance->AddInputConnection(1, ball->GetOutputPort()); // what moves, in model coordinates
  irradiance->SetDynamicTransform(0, worldFromBall);

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

  // For ParaView: the last frame with all its arrays.
  vtkNew<vtkXMLMultiBlockDataWriter> writer;
  writer->SetInputConnection(irradiance->GetOutputPort());
  writer->SetFileName("irradiance.vtm");
  writer->SetDataModeToBinary(); // Debian's ParaView cannot read the default, appended data
  writer->Write();

  // A picture from inside the room, in the colours of the array; VTK's own lights are off.
  vtkNew<vtkLookupTable> colours; // black, red, yellow, white
  colours->SetHueRange(0, 0.17);
  colours->SetSaturationRange(1, 0.4);
  colours->SetValueRange(0, 1);
  colours->SetRampToLinear();
  colours->SetTableRange(0, 6); // W/m2
  vtkNew<vtkCompositePolyDataMapper2> mapper;
  mapper->SetInputConnection(irradiance->GetOutputPort());
  mapper->SetScalarModeToUseCellFieldData();
  mapper->SelectColorArray("Irradiance");
  mapper->SetLookupTable(colours);
  mapper->UseLookupTableScalarRangeOn();
  vtkNew<vtkActor> scene;
  scene->SetMapper(mapper);
  scene->GetProperty()->LightingOff();
  vtkNew<vtkScalarBarActor> legend;
  legend->SetLookupTable(colours);
  legend->SetTitle("W/m2");

  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(scene);
  renderer->AddViewProp(legend);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetViewUp(0, 0, 1);
  camera->SetPosition(0, -1.95, 1.5);
  camera->SetFocalPoint(0, 0, 1.4);
  camera->SetViewAngle(75);
  renderer->ResetCameraClippingRange();
  vtkNew<vtkRenderWindow> window;
  window->OffScreenRenderingOn();
  window->SetSize(960, 720);
  window->AddRenderer(renderer);
  vtkNew<vtkWindowToImageFilter> grabber;
  grabber->SetInput(window);
  vtkNew<vtkPNGWriter> picture;
  picture->SetInputConnection(grabber->GetOutputPort());
  picture->SetFileName("irradiance.png");
  picture->Write();
  return 0;
}
