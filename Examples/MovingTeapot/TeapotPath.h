// SPDX-License-Identifier: BSD-3-Clause
/** The way of the teapot: lifted, moved to the left over the head as if to pour, set down. */
#ifndef TeapotPath_h
#define TeapotPath_h

#include <vtkNew.h>

class vtkTransform;
class vtkTupleInterpolator;

namespace movingteapot
{

class TeapotPath
{
public:
  TeapotPath();
  ~TeapotPath();

  /** Sets the pose of the teapot (teapotToRoom, rigid, m) at a time from 0 to 1. */
  void SetPose(double time, vtkTransform* teapotToRoom);

private:
  vtkNew<vtkTupleInterpolator> Poses; // x, y, z, turn, tilt
};

}

#endif
