// SPDX-License-Identifier: BSD-3-Clause
#include "UserMeshes.h"

#include "Shapes.h"

#include <vtkBoundingBox.h>
#include <vtkCellData.h>
#include <vtkPolyData.h>
#include <vtkTransformPolyDataFilter.h>
#include <vtkTriangleFilter.h>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace interactiveroom
{
namespace
{

Mesh ReadMesh(const char* option, const std::string& file, double unit)
{
  try
  {
    vtkNew<vtkTransform> metres;
    metres->Scale(unit, unit, unit);
    vtkNew<vtkTransformPolyDataFilter> scale;
    scale->SetInputData(movingteapot::ReadMeshFile(file));
    scale->SetTransform(metres);
    vtkNew<vtkTriangleFilter> triangles; // of strips
    triangles->SetInputConnection(scale->GetOutputPort());
    triangles->Update();
    return triangles->GetOutput();
  }
  catch (const std::runtime_error& error)
  {
    throw std::runtime_error(std::string(option) + ": " + error.what());
  }
}

bool Shines(vtkPolyData* mesh)
{
  return mesh->GetCellData()->HasArray("RadiantExitance") ||
    mesh->GetCellData()->HasArray("RadiantFlux");
}

// Above all else, half as long and as wide.
StillThing MakeLampAbove(const vtkBoundingBox& box)
{
  double centre[3], size[3];
  box.GetCenter(centre);
  box.GetLengths(size);
  const double largest = box.GetMaxLength();
  const double x = std::max(size[0], 0.2 * largest) / 4, y = std::max(size[1], 0.2 * largest) / 4;
  const double z = box.GetBound(5) + 0.1 * largest;
  return MakeLamp({ centre[0] - x, centre[0] + x, centre[1] - y, centre[1] + y, z, z }, 100);
}

// From the front and above, so far away that all is seen.
void SetView(const vtkBoundingBox& box, Room& room)
{
  double centre[3];
  box.GetCenter(centre);
  const double distance =
    0.6 * box.GetDiagonalLength() / std::tan(room.ViewAngle / 2 * std::acos(-1.0) / 180);
  room.Focus = { centre[0], centre[1], centre[2] };
  room.Eye = { centre[0], centre[1] - 0.94 * distance, centre[2] + 0.34 * distance };
}

}

Room ReadUserRoom(const std::vector<std::string>& stillFiles,
  const std::vector<std::string>& movingFiles, double unit)
{
  Room room;
  vtkBoundingBox box;
  bool isLit = false;
  const auto add = [&](vtkPolyData* mesh) {
    double b[6];
    mesh->GetBounds(b);
    box.AddBounds(b);
    isLit = isLit || Shines(mesh);
  };
  for (const std::string& file : stillFiles)
  {
    room.Still.push_back({ ReadMesh("--static", file, unit), false, true });
    add(room.Still.back().Mesh);
  }
  for (const std::string& file : movingFiles)
  {
    const Mesh mesh = ReadMesh("--dynamic", file, unit);
    const std::string name = vtksys::SystemTools::GetFilenameWithoutLastExtension(file);
    add(mesh);
    room.Moving.push_back(MakeMoving(name, mesh, 0.5, { 0, 0, 0 }));
  }
  if (!isLit)
  {
    room.Still.push_back(MakeLampAbove(box));
  }
  SetView(box, room);
  return room;
}

}
