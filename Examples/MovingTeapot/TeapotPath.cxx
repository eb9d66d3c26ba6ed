// SPDX-License-Identifier: BSD-3-Clause
#include "TeapotPath.h"

#include <vtkTransform.h>
#include <vtkTupleInterpolator.h>

#include <algorithm>
#include <iterator>

namespace movingteapot
{
namespace
{

struct Key
{
  double Time; // 0 to 1
  // Of the middle of the teapot's bottom (m), its turn about the vertical (at 180 degrees the spout
  // looks to the left), and its tilt towards the spout.
  double Pose[5];
};

constexpr Key Keys[] = {
  { 0.00, { 1.05, -0.35, 0.00, 180.0, 0.0 } },  // on the floor to the right of the head
  { 0.30, { 1.00, -0.20, 0.95, 180.0, 0.0 } },  // lifted
  { 0.48, { 0.36, 0.05, 1.30, 185.0, 30.0 } },  // over the head, tilted
  { 0.70, { -0.30, 0.05, 1.34, 240.0, 6.0 } },  // moved to the left
  { 0.86, { -1.00, -0.20, 0.80, 300.0, 0.0 } }, // going down
  { 1.00, { -1.05, -0.35, 0.00, 330.0, 0.0 } }, // on the floor to the left of the head
};

}

TeapotPath::TeapotPath()
{
  this->Poses->SetNumberOfComponents(5);
  this->Poses->SetInterpolationTypeToSpline();
  for (const Key& key : Keys)
  {
    double pose[5];
    std::copy(std::begin(key.Pose), std::end(key.Pose), pose);
    this->Poses->AddTuple(key.Time, pose);
  }
}

TeapotPath::~TeapotPath() = default;

void TeapotPath::SetPose(double time, vtkTransform* teapotToRoom)
{
  double pose[5];
  this->Poses->InterpolateTuple(time, pose);
  teapotToRoom->Identity();
  teapotToRoom->Translate(pose);
  teapotToRoom->RotateZ(pose[3]);
  teapotToRoom->RotateY(pose[4]);
}

}
