// SPDX-License-Identifier: BSD-3-Clause
/**
 * What stands in the picture: a closed room with a lamp under its ceiling, a head on a plinth, and
 * a teapot. Lengths in m, z up, the middle of the floor is the origin, one looks in along +y.
 */
#pragma once

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <string>

class vtkPolyData;
class vtkTransform;
class vtkTupleInterpolator;

namespace movingteapot
{

struct SceneConfig
{
  double CellSize = 0.046; // edge of the cells of walls and plinth, m
  int TeapotSegments = 10; // cuts along each edge of the teapot's patches
  std::string HeadFile;    // empty: the plinth stays empty
  std::string TeapotFile;  // empty: the Utah teapot
};

struct TeapotScene
{
  vtkSmartPointer<vtkPolyData> Room;
  vtkSmartPointer<vtkPolyData> Lamp; // with RadiantExitance, W/m2
  vtkSmartPointer<vtkPolyData> Plinth;
  vtkSmartPointer<vtkPolyData> Head;   // null without a head
  vtkSmartPointer<vtkPolyData> Teapot; // in its own frame: standing on the origin
};

/** Where these stand among the filter's static inputs, and so among its output's leaves. */
constexpr int RoomBlock = 0;
constexpr int LampBlock = 1;
constexpr int PlinthBlock = 2;

/** Throws std::runtime_error when a file cannot be used. */
TeapotScene MakeTeapotScene(const SceneConfig& config);

/** The way of the teapot: lifted, moved to the left over the head as if to pour, set down. */
class TeapotPath
{
public:
  TeapotPath();
  ~TeapotPath();

  /** Sets the pose of the teapot (rigid, m) at a time from 0 to 1. */
  void SetPose(double time, vtkTransform* roomFromTeapot);

private:
  vtkNew<vtkTupleInterpolator> Poses; // x, y, z, turn, tilt
};

}
