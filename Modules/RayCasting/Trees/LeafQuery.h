// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_LeafQuery_h
#define irradiance_LeafQuery_h

#include "Trees/TriangleTree.h"

#include <array>
#include <cstdint>

namespace irradiance
{

/// A point in the unit frame of a tree.
using UnitPoint = std::array<float, 3>;

inline UnitPoint unitPoint(const UnitFrame& frame, const Vector3& position)
{
  const Vector3 unit = frame(position);
  return { static_cast<float>(unit[0]), static_cast<float>(unit[1]), static_cast<float>(unit[2]) };
}

/// The squared distances, in the unit frame, from a point to the boxes of a treelet's children;
/// those of unused places are at least 1e30.
std::array<float, Treelet::kSize> squaredDistances(const Treelet& treelet, const UnitPoint& point);

/// No point of a triangle whose weights were rounded to floats lies farther than this from the box
/// of its leaf, in the unit frame: two weights and three coordinates, each off by 2^-24 of edges up
/// to 4 long.
constexpr float kStray = 0x1p-20F;

/**
 * The leaf whose box is nearest to a point, by the number of its first block. The box holds the
 * point, or all but holds it, if that lies on a triangle of the tree. Of several such leaves it is
 * always the same one. The tree must not be empty.
 */
std::uint32_t leafAt(const TriangleTree& tree, const UnitPoint& point);

}

#endif
