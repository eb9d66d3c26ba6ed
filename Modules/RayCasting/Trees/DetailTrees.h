// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Meshes/TriangleMesh.h"
#include "Trees/TriangleTree.h"

namespace irradiance
{

/**
 * The details of a mesh: parts, far smaller than all of it, of triangles so small that floats in
 * the frame of the whole mesh hardly tell them apart. A search there would meet most of them.
 * Returns the numbers of each one's triangles, in order; at most 16, those of the most triangles.
 */
std::vector<std::vector<std::uint32_t>> detailsOf(
  const TriangleMesh& mesh, const CancelPoint& cancelPoint = {});

/// Trees that together hold all triangles of a mesh with details: first all else, then each detail
/// in its own frame. None if it has no details.
std::vector<TriangleTree> detailTreesOf(
  const TriangleMesh& mesh, const CancelPoint& cancelPoint = {});

}
