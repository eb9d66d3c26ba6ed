// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "PathVertex.h"
#include "Surfaces/SceneObjects.h"

#include <vector>

namespace pathtracedroom
{

/// The values of a cell in an array of its material.
Spectrum spectrumOf(
  const irradiance::Material& material, const std::vector<double>& values, std::size_t cell);

/// W/m2; zero for a cell that is no lamp.
Spectrum exitanceOf(const irradiance::SceneObject& object, std::size_t cell);

/// The vertex at a point of a surface, with all that the cell there emits and reflects.
PathVertex vertexOn(const irradiance::SceneObjects& objects, const TriangleId& id,
  const irradiance::SurfacePoint& point);

}
