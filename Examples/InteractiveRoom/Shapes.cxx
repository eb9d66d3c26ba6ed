// SPDX-License-Identifier: BSD-3-Clause
#include "Shapes.h"

#include <vtkAppendPolyData.h>
#include <vtkCellData.h>
#include <vtkCleanPolyData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkParametricFunctionSource.h>
#include <vtkParametricTorus.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSphereSource.h>
#include <vtkSuperquadricSource.h>
#include <vtkTransformPolyDataFilter.h>
#include <vtkTriangleFilter.h>

namespace interactiveroom
{
namespace
{

// Triangles, so that no strip is one large cell, standing on the origin.
Mesh Standing(vtkAlgorithm* source)
{
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkCleanPolyData> merged; // seams close
  merged->SetInputConnection(triangles->GetOutputPort());
  merged->ConvertPolysToLinesOff();
  merged->ConvertLinesToPointsOff();
  merged->SetTolerance(1e-6);
  merged->Update();
  Mesh mesh = merged->GetOutput();
  mesh->GetPointData()->Initialize(); // normals and texture coordinates
  mesh->GetCellData()->Initialize();
  double b[6];
  mesh->GetBounds(b);
  return Moved(mesh, -(b[0] + b[1]) / 2, -(b[2] + b[3]) / 2, -b[4]);
}

}

void SetCellValue(vtkPolyData* mesh, const char* array, double value)
{
  vtkNew<vtkDoubleArray> values;
  values->SetName(array);
  values->SetNumberOfTuples(mesh->GetNumberOfCells());
  values->FillValue(value);
  mesh->GetCellData()->AddArray(values);
}

Mesh Append(const std::vector<Mesh>& meshes)
{
  vtkNew<vtkAppendPolyData> append;
  for (vtkPolyData* mesh : meshes)
  {
    append->AddInputData(mesh);
  }
  append->Update();
  return append->GetOutput();
}

Mesh Moved(vtkPolyData* mesh, double x, double y, double z)
{
  vtkNew<vtkTransform> worldFromMesh;
  worldFromMesh->Translate(x, y, z);
  vtkNew<vtkTransformPolyDataFilter> move;
  move->SetInputData(mesh);
  move->SetTransform(worldFromMesh);
  move->Update();
  return move->GetOutput();
}

Mesh MakeBall(double radius)
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(radius);
  source->SetThetaResolution(36);
  source->SetPhiResolution(24);
  return Standing(source);
}

Mesh MakeDrum(double radius, double height)
{
  vtkNew<vtkSuperquadricSource> source;
  source->SetZAxisOfSymmetry();
  source->SetPhiRoundness(0.25);
  source->SetThetaRoundness(1);
  source->SetThetaResolution(40);
  source->SetPhiResolution(24);
  source->SetSize(1);
  source->SetScale(radius, radius, height / 2);
  return Standing(source);
}

Mesh MakeRing(double radius, double thickness)
{
  vtkNew<vtkParametricTorus> torus;
  torus->SetRingRadius(radius);
  torus->SetCrossSectionRadius(thickness);
  vtkNew<vtkParametricFunctionSource> source;
  source->SetParametricFunction(torus);
  source->SetUResolution(48);
  source->SetVResolution(20);
  return Standing(source);
}

Mesh MakeTeapot(double width)
{
  const double w = width / 2;
  return movingteapot::FitMesh(
    movingteapot::MakeUtahTeapot(6), { -w, w, -w, w, 0, width }); // the width limits it
}

Mesh MakeBox(double x, double y, double z, double cellSize)
{
  return movingteapot::MakeGridBox({ -x / 2, x / 2, -y / 2, y / 2, 0, z }, cellSize,
    movingteapot::Facing::Outward, { { 0.5, 0.5, 0.5, 0.5, 0.5, 0.5 } });
}

StillThing MakeLamp(const movingteapot::Box& place, double exitance)
{
  constexpr std::optional<double> none;
  Mesh lamp = movingteapot::MakeGridBox(
    place, 0.5, movingteapot::Facing::Outward, { { none, none, none, none, 0.7, none } });
  SetCellValue(lamp, "RadiantExitance", exitance);
  return { lamp, true, false };
}

MovingThing MakeMoving(const std::string& name, Mesh mesh, double reflectance,
  const std::array<double, 3>& place, double turn)
{
  if (!mesh->GetCellData()->HasArray("DiffuseReflectance"))
  {
    SetCellValue(mesh, "DiffuseReflectance", reflectance);
  }
  vtkNew<vtkTransform> worldFromMesh;
  worldFromMesh->Translate(place.data());
  worldFromMesh->RotateZ(turn);
  movingteapot::SetName(mesh, name);
  return { name, mesh, worldFromMesh.Get() };
}

}
