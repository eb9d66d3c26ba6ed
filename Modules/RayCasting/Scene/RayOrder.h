// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_RayOrder_h
#define irradiance_RayOrder_h

#include "Geometry/Ray.h"

#include <cstdint>
#include <vector>

namespace irradiance
{

/// The rays of a batch in an order in which those with like origins and directions are neighbours,
/// so that they read the same parts of a large tree; empty if they are so already. Only the time
/// depends on it.
std::vector<std::uint32_t> coherentOrder(const Ray* rays, std::uint32_t count, const Box& bounds);

}

#endif
