// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_BoxQuery_h
#define irradiance_BoxQuery_h

#include "Trees/TriangleTree.h"

#include <cstdint>
#include <vector>

namespace irradiance
{

/// Numbers of the triangles that may touch a box in the space of the tree's triangles, in order, each
/// once: all that do, and some of their neighbours.
std::vector<std::uint32_t> trianglesNear(const TriangleTree& tree, const Box& box);

}

#endif
