// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_RayOrder_h
#define irradiance_RayOrder_h

#include "Geometry/Ray.h"

#include <cstdint>
#include <vector>

namespace irradiance
{

/// An order of a batch in which rays with similar origins and directions are neighbours, so that
/// they read the same parts of a large tree; empty if they are in such an order already. Only the
/// time depends on it.
std::vector<std::uint32_t> coherentOrder(const Ray* rays, std::uint32_t count, const Box& bounds);

}

#endif
