// SPDX-License-Identifier: BSD-3-Clause
#include "TeapotScene.h"

#include "GridBox.h"
#include "MeshFile.h"
#include "UtahTeapot.h"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

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

vtkSmartPointer<vtkPolyData> MakeRoom(double cellSize)
{
  const double wall = WallReflectance;
  return MakeGridBox(RoomBox, cellSize, Facing::Inward,
    { { wall, wall, wall, wall, FloorReflectance, CeilingReflectance } });
}

vtkSmartPointer<vtkPolyData> MakeLamp()
{
  const double cellSize = 0.2;
  auto lamp = MakeGridBox(LampBox, cellSize, Facing::Outward,
    { { none, none, none, none, CeilingReflectance,
      none } }); // the lower side alone: its front looks down
  SetCellConstant(lamp, "RadiantExitance", LampExitance);
  return lamp;
}

vtkSmartPointer<vtkPolyData> MakePlinth(double cellSize)
{
  const double wall = WallReflectance;
  return MakeGridBox(
    PlinthBox, cellSize, Facing::Outward, { { wall, wall, wall, wall, none, wall } });
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

vtkSmartPointer<vtkPolyData> MakeHead(const std::string& file)
{
  return MakePlaster(FitMesh(ReadMeshFile(file), HeadBox));
}

vtkSmartPointer<vtkPolyData> MakeTeapot(const std::string& file, int segments)
{
  auto mesh = file.empty() ? MakeUtahTeapot(segments) : ReadMeshFile(file);
  return MakePlaster(FitMesh(mesh, TeapotBox));
}

}

TeapotScene MakeTeapotScene(const SceneConfig& config)
{
  TeapotScene scene;
  scene.Room = MakeRoom(config.CellSize);
  scene.Lamp = MakeLamp();
  scene.Plinth = MakePlinth(config.CellSize);
  scene.Head = config.HeadFile.empty() ? nullptr : MakeHead(config.HeadFile);
  scene.Teapot = MakeTeapot(config.TeapotFile, config.TeapotSegments);
  return scene;
}

}
