// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Ray.h"
#include "Meshes/TriangleMesh.h"

#include <functional>
#include <vector>

/// Casts the rays that it was made for: sets hits[i] for the i-th. This is timed. Only the
/// distances of hits are compared; what the numbers in an id mean is the rival's own affair.
using Cast = std::function<void(std::vector<irradiance::Hit>& hits)>;

/// A rival whose trees are built. It brings rays into the form that it takes; this is not timed.
using Caster = std::function<Cast(const std::vector<irradiance::Ray>& rays)>;

/// CGAL's AABB_tree over Simple_cartesian<double>, its fastest kernel.
Caster makeCgalCaster(const irradiance::TriangleMesh& mesh);

/// VTK's vtkStaticCellLocator.
Caster makeVtkCaster(const irradiance::TriangleMesh& mesh);
