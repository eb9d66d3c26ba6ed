// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_BoxQuery_h
#define irradiance_BoxQuery_h

#include "Trees/TriangleTree.h"

#include <cstdint>
#include <vector>

namespace irradiance
{

/// The numbers of all triangles that touch a box in the space of the tree's triangles, and of some
/// of their neighbours, in ascending order, each once.
std::vector<std::uint32_t> trianglesNear(const TriangleTree& tree, const Box& box);

}

#endif
