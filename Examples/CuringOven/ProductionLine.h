// SPDX-License-Identifier: BSD-3-Clause
/** Parts on the conveyor, and the light that they receive in the oven over time. */
#pragma once

#include "OvenOptions.h"

#include <vtkSmartPointer.h>

#include <string>
#include <vector>

class vtkIrradianceFilter;
class vtkPolyData;

namespace curingoven
{

struct Part
{
  std::string Name;
  vtkSmartPointer<vtkPolyData> Mesh; // in m; the middle of its foot is at (0, 0, Lift)
};

constexpr double Lift = 0.05;    // m above the belt, where thin pins hold the parts
constexpr double Spacing = 0.45; // m from one part on the belt to the next

/** Of the options. Throws std::runtime_error that names the option and the file. */
std::vector<Part> ReadParts(const OvenOptions& options);

/** The time at which a part is put on the belt, s. The first one: 0. */
double EntryTime(const OvenOptions& options, int part);
/** The time at which a part is taken off the belt, s. */
double ExitTime(const OvenOptions& options, int part);

/**
 * The whole line: the oven's meshes are static, the parts dynamic, and each part is there only
 * while it is on the belt.
 */
vtkSmartPointer<vtkIrradianceFilter> MakeLight(
  const OvenOptions& options, const std::vector<Part>& parts, int walks);

}
