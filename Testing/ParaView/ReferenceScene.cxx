// SPDX-License-Identifier: BSD-3-Clause
// Writes the files of a small scene that moves, and what the C++ filter makes of them. The Python
// package and the ParaView plugin read the same files and must find the same bits.
//
//   ReferenceScene FOLDER     writes room.vtp, part.vtp, poses.csv, irradiance-<time>.vtm, and defaults.txt
#include "vtkAppendPolyData.h"
#include "vtkCellData.h"
#include "vtkCubeSource.h"
#include "vtkDoubleArray.h"
#include "vtkIrradianceFilter.h"
#include "vtkKeyFramedPose.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"
#include "vtkTessellatedBoxSource.h"
#include "vtkXMLMultiBlockDataWriter.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <fstream>
#include <iostream>
#include <string>

namespace
{

void addArray(vtkPolyData* polyData, const char* name, double value)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfTuples(polyData->GetNumberOfCells());
  array->Fill(value);
  polyData->GetCellData()->AddArray(array);
}

vtkSmartPointer<vtkPolyData> withMaterial(
  vtkPolyDataAlgorithm* source, double exitance, double reflectance)
{
  source->Update();
  vtkSmartPointer<vtkPolyData> polyData = source->GetOutput();
  addArray(polyData, "RadiantExitance", exitance);
  addArray(polyData, "DiffuseReflectance", reflectance);
  return polyData;
}

void write(vtkAlgorithm* source, const std::string& file)
{
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputConnection(source->GetOutputPort());
  writer->SetFileName(file.c_str());
  writer->SetDataModeToBinary(); // ParaView 5.11 with Debian's libexpat cannot read appended data
  writer->Write();
}

/// 4 x 4 x 3 m, with a lamp of a square metre below the ceiling that shines down.
void writeRoom(const std::string& file)
{
  vtkNew<vtkTessellatedBoxSource> walls;
  walls->SetBounds(-2, 2, -2, 2, 0, 3);
  walls->SetLevel(12);
  walls->QuadsOn();
  vtkNew<vtkPlaneSource> lamp;
  lamp->SetOrigin(-0.5, -0.5, 2.9);
  lamp->SetPoint1(-0.5, 0.5, 2.9);
  lamp->SetPoint2(0.5, -0.5, 2.9);
  vtkNew<vtkAppendPolyData> room;
  room->AddInputData(withMaterial(walls, 0, 0.6));
  room->AddInputData(withMaterial(lamp, 100, 0));
  write(room, file);
}

/// A block with a ball on it, around the origin.
void writePart(const std::string& file)
{
  vtkNew<vtkCubeSource> block;
  block->SetBounds(-0.4, 0.4, -0.3, 0.3, -0.3, 0);
  vtkNew<vtkSphereSource> ball;
  ball->SetCenter(0, 0, 0.3);
  ball->SetRadius(0.25);
  ball->SetThetaResolution(24);
  ball->SetPhiResolution(16);
  vtkNew<vtkAppendPolyData> part;
  part->AddInputData(withMaterial(block, 0, 0.3));
  part->AddInputData(withMaterial(ball, 0, 0.8));
  write(part, file);
}

}

int main(int argc, char* argv[])
{
  if (argc != 2)
  {
    std::cerr << "usage: ReferenceScene FOLDER\n";
    return 2;
  }
  const std::string folder = std::string(argv[1]) + "/";
  writeRoom(folder + "room.vtp");
  writePart(folder + "part.vtp");
  std::ofstream(folder + "poses.csv") << "time,x,y,z,rx,ry,rz\n"
                                         "0,-1.2,0,0.4,0,0,0\n"
                                         "1,0,0.3,0.9,20,10,80\n"
                                         "2,1.3,-0.2,0.4,0,0,120\n";

  vtkNew<vtkXMLPolyDataReader> room, part;
  room->SetFileName((folder + "room.vtp").c_str());
  part->SetFileName((folder + "part.vtp").c_str());
  vtkNew<vtkKeyFramedPose> pose;
  pose->SetInputConnection(part->GetOutputPort());
  pose->SetFileName((folder + "poses.csv").c_str());
  vtkNew<vtkIrradianceFilter> irradiance;
  std::ofstream defaults(folder + "defaults.txt");
  irradiance->Print(defaults);
  defaults.close();
  irradiance->AddInputConnection(0, room->GetOutputPort());
  irradiance->AddInputConnection(1, pose->GetOutputPort());
  irradiance->SetNumberOfWalks(100000);
  irradiance->ComputeStandardErrorOn();
  for (const char* time : { "0", "0.375", "1", "1.7", "2" })
  {
    irradiance->UpdateTimeStep(std::stod(time));
    vtkNew<vtkXMLMultiBlockDataWriter> writer;
    writer->SetInputData(irradiance->GetOutput());
    writer->SetFileName((folder + "irradiance-" + time + ".vtm").c_str());
    writer->SetDataModeToBinary();
    if (writer->Write() != 1)
    {
      return 1;
    }
  }
  return 0;
}
