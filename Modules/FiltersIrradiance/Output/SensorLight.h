// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Output/LightArrays.h"
#include "Views/GroupSensors.h"

#include <string>
#include <vector>

class vtkDataSet;

namespace irradiance
{

/// Sensors that are to be measured, and where the values go: to point arrays of the output.
struct SensorRun
{
  const std::vector<Sensor>& sensors;
  const LightGroups& groups; ///< of the scene, up to date
  Execution& execution;
  vtkDataSet* output;          ///< with a point for each sensor
  bool areGroupsApart = false; ///< whether gathered light of each group has arrays of its own
};

/// Adds the arrays of what sensors gather: irradiance, or the fluence rate of sensors without
/// normals; with `haveErrors` one of standard errors.
LightArrays addGatheredLight(vtkDataSet* output, int bands, bool haveNormals, bool haveErrors);
/// Fills these by so many rays for each sensor, see SensorFinalGather; what is `stored` is used
/// again, and updated. Returns a warning, or nothing. Throws Interrupted, and what
/// SensorFinalGather throws.
std::string gatherLight(
  const SensorRun& run, const LightArrays& arrays, std::uint32_t rays, GroupSensors& stored);

/// Adds the arrays of what the photons nearest to sensors tell.
void addNearestLight(vtkDataSet* output, int bands);
/// Adds and fills these, by so many photons (>= 2) for each sensor. `maximumRadius`,
/// `maximumDistance`: m; 0: what suits the scene. Collects photons and surfaces first. Returns a
/// warning, or nothing. Throws Interrupted.
std::string measureNearestLight(
  const SensorRun& run, std::uint32_t photons, double maximumRadius, double maximumDistance);

}
