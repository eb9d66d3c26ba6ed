// SPDX-License-Identifier: BSD-3-Clause
/** Things of simple shape, each standing with the middle of its foot on the origin. Lengths in m. */
#pragma once

#include "Room.h"

namespace interactiveroom
{

using Mesh = vtkSmartPointer<vtkPolyData>;

/** The same value for all cells. */
void SetCellValue(vtkPolyData* mesh, const char* array, double value);

Mesh Append(const std::vector<Mesh>& meshes);

Mesh MakeBall(double radius);
Mesh MakeDrum(double radius, double height);
Mesh MakeRing(double radius, double thickness);
Mesh MakeTeapot(double width);

/** A closed box of cells of about `cellSize`. */
Mesh MakeBox(double x, double y, double z, double cellSize);

/** A rectangle under the ceiling that shines downwards with `exitance` W/m2. */
StillThing MakeLamp(const movingteapot::Box& place, double exitance);

/** At a place, turned about the vertical (degrees), with a diffuse reflectance unless the mesh has one. */
MovingThing MakeMoving(const std::string& name, Mesh mesh, double reflectance,
  const std::array<double, 3>& place, double turn = 0);

/** A mesh in its place. */
Mesh Moved(vtkPolyData* mesh, double x, double y, double z);

}
