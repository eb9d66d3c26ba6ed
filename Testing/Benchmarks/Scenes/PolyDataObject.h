// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Surfaces/SceneObjects.h"

#include <vector>

class vtkPolyData;

/// Of all polygons; those without area are left out.
std::vector<irradiance::Triangle> trianglesOf(vtkPolyData* mesh);

/// The polygons of some polydata as one object, with their cell arrays RadiantExitance and
/// DiffuseReflectance (one component; where there is none: no light, 0.5), as the filter reads
/// them.
irradiance::SceneObject makeObject(const std::vector<vtkPolyData*>& parts);
