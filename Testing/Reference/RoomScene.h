// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkCamera.h>
#include <vtkIrradianceFilter.h>
#include <vtkNew.h>

#include <string>

namespace pathtracedroom
{

/** A scene, as the inputs of a vtkIrradianceFilter, and how it is looked at. Lengths in m, z up. */
struct RoomScene
{
  vtkNew<vtkIrradianceFilter> Light;
  vtkNew<vtkCamera> Camera;
  double Exposure; // of the picture, m2 sr/W
};

/**
 * "room": between a red and a blue wall, before one of coloured bands, a teapot of china stands and
 * one of copper hangs, which may move; a lamp, and a mirror. Three bands. "teapots": the experiment
 * of the paper's section 2.5 with teapots for chickens: two stand on a floor, two hang over it and
 * may move. One band; `segments` cuts along each edge of a teapot patch. Throws std::runtime_error
 * for another name.
 */
void MakeRoomScene(const std::string& name, int segments, RoomScene& scene);

}
