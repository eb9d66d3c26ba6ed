// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Meshes.h"

#include <vtkSmartPointer.h>
#include <vtkTransform.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

class vtkPolyData;

namespace interactiveroom
{

/** What stays where it is. */
struct StillThing
{
  vtkSmartPointer<vtkPolyData> Mesh; // in the world, m
  bool IsLamp = false;               // drawn white
  bool IsOpen = false;               // drawn without the cells that face away: one looks in
};

/** What the user moves. */
struct MovingThing
{
  std::string Name;
  vtkSmartPointer<vtkPolyData> Mesh;           // in its own frame, m
  vtkSmartPointer<vtkTransform> WorldFromMesh; // at the start
};

struct Room
{
  std::vector<StillThing> Still;
  std::vector<MovingThing> Moving;
  std::optional<movingteapot::Box> Limits; // m; what moves stays in here
  std::array<double, 3> Eye, Focus;        // m; z is up
  double ViewAngle = 30;                   // degrees
};

}
