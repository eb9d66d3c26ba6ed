// SPDX-License-Identifier: BSD-3-Clause
#include "TeapotScene.h"

#include "Meshes.h"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkTransform.h>
#include <vtkTupleInterpolator.h>

namespace movingteapot
{
namespace
{

constexpr Box RoomBox = { -1.7, 1.7, -1.1, 1.1, 0.0, 2.4 };
constexpr Box PlinthBox = { -0.25, 0.25, -0.13, 0.37, 0.0, 0.6 };
constexpr Box HeadBox = { -0.3, 0.3, -0.18, 0.42, 0.6, 1.2 };
constexpr Box TeapotBox = { -0.27, 0.27, -0.27, 0.27, 0.0, 0.54 }; // in its own frame
constexpr Box LampBox = { -0.8, 0.8, -0.9, 0.1, 2.39, 2.39 };
constexpr double LampExitance = 150.0; // W/m2; 240 W in all

// Floor dark, walls grey, ceiling light, as in the usual office.
constexpr double FloorReflectance = 0.2;
constexpr double WallReflectance = 0.5;
constexpr double CeilingReflectance = 0.7;
constexpr double PlasterReflectance = 0.7;
constexpr std::optional<double> none;

void SetCellConstant(vtkPolyData* mesh, const char* name, double value)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfTuples(mesh->GetNumberOfCells());
  array->FillValue(value);
  mesh->GetCellData()->AddArray(array);
}

// A mesh that says nothing of its material is taken to be of white plaster.
vtkSmartPointer<vtkPolyData> MakePlaster(vtkSmartPointer<vtkPolyData> mesh)
{
  if (!mesh->GetCellData()->HasArray("DiffuseReflectance"))
  {
    SetCellConstant(mesh, "DiffuseReflectance", PlasterReflectance);
  }
  return mesh;
}

// A time, 0 to 1, and then: the middle of the teapot's bottom (m), its turn about the vertical (at
// 180 degrees the spout looks to the left), and its tilt towards the spout.
constexpr double Keys[][6] = {
  { 0.00, 1.05, -0.35, 0.00, 180.0, 0.0 },  // on the floor to the right of the head
  { 0.30, 1.00, -0.20, 0.95, 180.0, 0.0 },  // lifted
  { 0.48, 0.36, 0.05, 1.30, 185.0, 30.0 },  // over the head, tilted
  { 0.70, -0.30, 0.05, 1.34, 240.0, 6.0 },  // moved to the left
  { 0.86, -1.00, -0.20, 0.80, 300.0, 0.0 }, // going down
  { 1.00, -1.05, -0.35, 0.00, 330.0, 0.0 }, // on the floor to the left of the head
};

}

TeapotScene MakeTeapotScene(const SceneConfig& config)
{
  const double wall = WallReflectance, ceiling = CeilingReflectance, lampCellSize = 0.2;
  TeapotScene scene;
  scene.Room = MakeGridBox(RoomBox, config.CellSize, Facing::Inward,
    { { wall, wall, wall, wall, FloorReflectance, ceiling } });
  // The lower side alone: its front looks down.
  scene.Lamp = MakeGridBox(
    LampBox, lampCellSize, Facing::Outward, { { none, none, none, none, ceiling, none } });
  SetCellConstant(scene.Lamp, "RadiantExitance", LampExitance);
  scene.Plinth = MakeGridBox(
    PlinthBox, config.CellSize, Facing::Outward, { { wall, wall, wall, wall, none, wall } });
  if (!config.HeadFile.empty())
  {
    scene.Head = MakePlaster(FitMesh(ReadMeshFile(config.HeadFile), HeadBox));
  }
  const auto teapot = config.TeapotFile.empty() ? MakeUtahTeapot(config.TeapotSegments)
                                                : ReadMeshFile(config.TeapotFile);
  scene.Teapot = MakePlaster(FitMesh(teapot, TeapotBox));
  SetName(scene.Room, "room");
  SetName(scene.Lamp, "lamp");
  SetName(scene.Plinth, "plinth");
  if (scene.Head)
  {
    SetName(scene.Head, "head");
  }
  SetName(scene.Teapot, "teapot");
  return scene;
}

TeapotPath::TeapotPath()
{
  this->Poses->SetNumberOfComponents(5);
  this->Poses->SetInterpolationTypeToSpline();
  for (auto [time, x, y, z, turn, tilt] : Keys)
  {
    double pose[5] = { x, y, z, turn, tilt };
    this->Poses->AddTuple(time, pose);
  }
}

TeapotPath::~TeapotPath() = default;

void TeapotPath::SetPose(double time, vtkTransform* roomFromTeapot)
{
  double pose[5];
  this->Poses->InterpolateTuple(time, pose);
  roomFromTeapot->Identity();
  roomFromTeapot->Translate(pose);
  roomFromTeapot->RotateZ(pose[3]);
  roomFromTeapot->RotateY(pose[4]);
}

}
