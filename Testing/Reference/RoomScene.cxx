// SPDX-License-Identifier: BSD-3-Clause
#include "RoomScene.h"

#include "Meshes.h"

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkMath.h>
#include <vtkPlaneSource.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkTransform.h>

#include <array>
#include <cmath>
#include <stdexcept>

namespace pathtracedroom
{
namespace
{

using Mesh = vtkSmartPointer<vtkPolyData>;
using Colour = std::array<double, 3>; // one value for each band
using movingteapot::Facing;

constexpr Colour White = { 0.75, 0.75, 0.75 };
constexpr Colour Red = { 0.65, 0.12, 0.1 };
constexpr Colour Blue = { 0.1, 0.22, 0.6 };
constexpr Colour Wood = { 0.45, 0.3, 0.18 };
constexpr Colour Bands[] = { { 0.7, 0.2, 0.15 }, { 0.75, 0.6, 0.15 }, { 0.2, 0.5, 0.2 },
  { 0.15, 0.4, 0.65 }, { 0.45, 0.2, 0.5 } };

// A value for each cell, as a function of its centre.
template <typename Values>
void SetCells(vtkPolyData* mesh, const char* name, const Values& valuesAt)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    double bounds[6];
    mesh->GetCellBounds(i, bounds);
    const Colour values = valuesAt(Colour{ 0.5 * (bounds[0] + bounds[1]),
      0.5 * (bounds[2] + bounds[3]), 0.5 * (bounds[4] + bounds[5]) });
    array->InsertNextTuple(values.data());
  }
  mesh->GetCellData()->AddArray(array);
}

void SetAllCells(vtkPolyData* mesh, const char* name, const Colour& values)
{
  SetCells(mesh, name, [&](const Colour&) { return values; });
}

void SetGloss(vtkPolyData* mesh, const Colour& diffuse, const Colour& specular, double exponent)
{
  SetAllCells(mesh, "DiffuseReflectance", diffuse);
  SetAllCells(mesh, "SpecularReflectance", specular);
  vtkNew<vtkDoubleArray> exponents;
  exponents->SetName("PhongExponent");
  exponents->SetNumberOfTuples(mesh->GetNumberOfCells());
  exponents->FillValue(exponent);
  mesh->GetCellData()->AddArray(exponents);
}

// The front faces (point1 - origin) x (point2 - origin).
Mesh MakeRectangle(const Colour& origin, const Colour& point1, const Colour& point2)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(origin[0], origin[1], origin[2]);
  plane->SetPoint1(point1[0], point1[1], point1[2]);
  plane->SetPoint2(point2[0], point2[1], point2[2]);
  plane->Update();
  return plane->GetOutput();
}

// It shines down.
Mesh MakeLamp(double halfWidth, double halfDepth, double height, const Colour& exitance)
{
  Mesh lamp = MakeRectangle({ -halfWidth, -halfDepth, height }, { -halfWidth, halfDepth, height },
    { halfWidth, -halfDepth, height });
  SetAllCells(lamp, "RadiantExitance", exitance);
  return lamp;
}

Mesh MakeTeapot(int segments, double edge)
{
  return movingteapot::FitMesh(movingteapot::MakeUtahTeapot(segments),
    { -0.5 * edge, 0.5 * edge, -0.5 * edge, 0.5 * edge, 0, edge });
}

// Placed for good: a static teapot.
Mesh Placed(vtkPolyData* mesh, vtkTransform* pose)
{
  Mesh placed = Mesh::New();
  placed->DeepCopy(mesh);
  vtkNew<vtkPoints> points;
  pose->TransformPoints(mesh->GetPoints(), points);
  placed->SetPoints(points);
  return placed;
}

vtkSmartPointer<vtkTransform> MakePose(const Colour& position, double turn, double tilt)
{
  auto pose = vtkSmartPointer<vtkTransform>::New();
  pose->Translate(position.data());
  pose->RotateZ(turn);
  pose->RotateY(tilt);
  return pose;
}

void AddDynamic(RoomScene& scene, vtkPolyData* mesh, vtkTransform* pose)
{
  const int index = scene.Light->GetNumberOfInputConnections(1);
  scene.Light->AddInputDataObject(1, mesh);
  scene.Light->SetDynamicTransform(index, pose);
}

void LookFrom(RoomScene& scene, const Colour& position, const Colour& focus, double angle)
{
  scene.Camera->SetPosition(position.data());
  scene.Camera->SetFocalPoint(focus.data());
  scene.Camera->SetViewUp(0, 0, 1);
  scene.Camera->SetViewAngle(angle);
}

Colour WallColour(const Colour& centre, const double* bounds)
{
  constexpr double close = 1e-6;
  if (centre[0] < bounds[0] + close)
  {
    return Red;
  }
  if (centre[0] > bounds[1] - close)
  {
    return Blue;
  }
  if (centre[2] < bounds[4] + close)
  {
    return Wood;
  }
  const bool isBanded = centre[1] > bounds[3] - close && centre[2] > 0.4 && centre[2] < 2;
  const double width = (bounds[1] - bounds[0]) / 5;
  return isBanded ? Bands[int((centre[0] - bounds[0]) / width)] : White;
}

void MakeRoom(int segments, RoomScene& scene)
{
  const double grey = 0.5; // replaced below
  const movingteapot::Box box = { -1.75, 1.75, -2.2, 1.5, 0, 2.4 };
  Mesh room = movingteapot::MakeGridBox(
    box, 0.35, Facing::Inward, { { grey, grey, grey, grey, grey, grey } });
  SetCells(room, "DiffuseReflectance",
    [&](const Colour& centre) { return WallColour(centre, box.data()); });
  Mesh lamp = MakeLamp(0.6, 0.4, 2.38, { 22, 20, 17 });
  // It leans against the blue wall.
  Mesh mirror = MakeRectangle({ 1.4, 0.2, 0.02 }, { 1.4, 1.1, 0.02 }, { 1.72, 0.2, 1.5 });
  SetGloss(mirror, { 0, 0, 0 }, { 0.9, 0.9, 0.9 }, vtkMath::Inf());
  Mesh teapot = MakeTeapot(segments, 1.1);
  const auto standing = MakePose({ -0.7, 0.2, 0 }, 20, 0);
  Mesh china = Placed(teapot, standing);
  SetGloss(china, { 0.65, 0.65, 0.6 }, { 0.15, 0.15, 0.15 }, 400);
  Mesh copper = Mesh::New();
  copper->DeepCopy(teapot);
  SetGloss(copper, { 0.1, 0.05, 0.03 }, { 0.8, 0.52, 0.38 }, 60);
  for (vtkPolyData* still : { room.Get(), lamp.Get(), mirror.Get(), china.Get() })
  {
    scene.Light->AddInputDataObject(0, still);
  }
  AddDynamic(scene, copper, MakePose({ 0.45, 0.3, 0.85 }, 190, 25));
  LookFrom(scene, { 0, -2.15, 1.3 }, { 0, 0, 1.2 }, 62);
  scene.Exposure = 2.2;
}

void MakeTeapots(int segments, RoomScene& scene)
{
  Mesh teapot = MakeTeapot(segments, 1.5);
  Mesh floor = MakeRectangle({ -3, -3, 0 }, { 3, -3, 0 }, { -3, 3, 0 });
  Mesh lamp = MakeLamp(1, 1, 4, { 30, 30, 30 });
  scene.Light->AddInputDataObject(0, floor);
  scene.Light->AddInputDataObject(0, lamp);
  for (const double side : { -1.0, 1.0 })
  {
    const auto standing = MakePose({ side, 0.4, 0 }, 90 * side, 0);
    scene.Light->AddInputDataObject(0, Placed(teapot, standing));
    AddDynamic(scene, teapot, MakePose({ 0.9 * side, -0.3, 1.3 }, 60 * side, 30));
  }
  LookFrom(scene, { 0, -6, 2.2 }, { 0, 0, 1.2 }, 35);
  scene.Exposure = 0.3;
}

}

void MakeRoomScene(const std::string& name, int segments, RoomScene& scene)
{
  if (name == "room")
  {
    MakeRoom(segments, scene);
  }
  else if (name == "teapots")
  {
    MakeTeapots(segments, scene);
  }
  else
  {
    throw std::runtime_error("there is no scene \"" + name + "\", only room and teapots");
  }
}

}
