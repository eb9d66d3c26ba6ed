// SPDX-License-Identifier: BSD-3-Clause
/**
 * What stands still: a tunnel of aluminium sheet over a conveyor, with strip lamps in parabolic
 * reflectors under its ceiling. In m: x along the conveyor, y across it, z up from the belt; the
 * origin is in the middle of the tunnel.
 */
#ifndef Oven_h
#define Oven_h

#include <vtkSmartPointer.h>

#include <vector>

class vtkPolyData;

namespace curingoven
{

constexpr double TunnelEnd = 1.5; // the tunnel is from -TunnelEnd to TunnelEnd
constexpr double TunnelSide = 0.4;
constexpr double TunnelHeight = 0.5;
constexpr double Opening = 0.28; // height of the openings at its ends
constexpr double BeltEnd = 2.0;  // where parts are put on the belt, and taken off
constexpr double LampPitch = 0.3;
constexpr int MostLamps = 9;

/** The meshes of MakeOven, in their order. */
enum OvenMesh
{
  Lamps,
  Reflectors,
  Tunnel,
  Belt,
  NumberOfOvenMeshes
};

/** `lampPower`: W of UV from each lamp. */
std::vector<vtkSmartPointer<vtkPolyData>> MakeOven(int lamps, double lampPower);

}

#endif
