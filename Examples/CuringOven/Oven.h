// SPDX-License-Identifier: BSD-3-Clause
/**
 * What stands still: a tunnel of aluminium sheet over a conveyor, with strip lamps in parabolic
 * reflectors under its ceiling. In m: x along the conveyor, y across it, z up from the belt; the
 * origin is in the middle of the tunnel.
 */
#pragma once

#include "OvenOptions.h"

#include <vtkSmartPointer.h>

#include <vector>

class vtkPolyData;

namespace curingoven
{

constexpr double LampRadius = 0.012; // a quartz tube of 24 mm
constexpr double FocalLength = 0.025;
constexpr double ReflectorHalfWidth = 0.06;

/** Where parts are put on the belt (at minus that) and taken off. */
inline double BeltEnd(const OvenOptions& options)
{
  return options.OvenLength / 2 + 0.5;
}

/** Lamps and their reflectors end 0.1 m from the sides of the tunnel. */
inline double LampLength(const OvenOptions& options)
{
  return options.OvenWidth - 0.2;
}

/** The meshes of MakeOven, in their order. */
enum OvenMesh
{
  Lamps,
  Reflectors,
  Tunnel,
  Belt,
  NumberOfOvenMeshes
};

std::vector<vtkSmartPointer<vtkPolyData>> MakeOven(const OvenOptions& options);

}
