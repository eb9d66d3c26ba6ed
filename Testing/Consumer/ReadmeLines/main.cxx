// A room with a lamp, and a ball that moves through it: the lines of the README, as a program.
#include <vtkCellData.h>
#include <vtkCubeSource.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkIrradianceFilter.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPolyData.h>
#include <vtkSphereSource.h>
#include <vtkTransform.h>

#include <iostream>

int main()
{
  vtkNew<vtkCubeSource> room; // seen from inside; lengths in m
  room->SetBounds(-2, 2, -2, 2, 0, 3);

  vtkNew<vtkPlaneSource> lamp; // its front looks down
  lamp->SetOrigin(-0.5, -0.5, 2.9);
  lamp->SetPoint1(-0.5, 0.5, 2.9);
  lamp->SetPoint2(0.5, -0.5, 2.9);
  lamp->Update();
  vtkNew<vtkDoubleArray> exitance;
  exitance->SetName("RadiantExitance");
  exitance->InsertNextValue(100); // W/m2
  lamp->GetOutput()->GetCellData()->AddArray(exitance);

  vtkNew<vtkSphereSource> ball;
  vtkNew<vtkTransform> worldFromBall;

  vtkNew<vtkIrradianceFilter> irradiance;
  irradiance->AddInputConnection(0, room->GetOutputPort());
  irradiance->AddInputDataObject(0, lamp->GetOutput());
  irradiance->AddInputConnection(1, ball->GetOutputPort());
  irradiance->SetDynamicTransform(0, worldFromBall);
  irradiance->SetNumberOfWalks(100000);

  for (int frame = 0; frame < 3; ++frame)
  {
    worldFromBall->Identity();
    worldFromBall->Translate(frame - 1, 0, 1);
    irradiance->Update();

    auto* statics = vtkMultiBlockDataSet::SafeDownCast(irradiance->GetOutput()->GetBlock(0));
    auto* lit = statics ? vtkPolyData::SafeDownCast(statics->GetBlock(0)) : nullptr;
    vtkDataArray* values = lit ? lit->GetCellData()->GetArray("Irradiance") : nullptr;
    if (!values)
    {
      std::cerr << "no irradiance\n";
      return 1;
    }
    double range[2];
    values->GetRange(range);
    std::cout << "Irradiance " << range[0] << " to " << range[1] << " W/m2\n";
  }
  return 0;
}
