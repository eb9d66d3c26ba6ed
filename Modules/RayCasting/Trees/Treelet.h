// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Treelet_h
#define irradiance_Treelet_h

#include <array>
#include <cstdint>

namespace irradiance
{

/**
 * A piece of a kd-tree: up to 15 of its planes, which separate up to 16 children. For each child it
 * keeps the box that its triangles fill. One SIMD step finds which of the 16 a ray visits.
 */
struct alignas(64) Treelet
{
  static constexpr unsigned kSize = 16;
  static constexpr std::uint32_t kLeaf = 0x80000000u;  ///< set with the number of the first block
  static constexpr std::uint32_t kEmpty = 0xffffffffu; ///< no child
  static constexpr float kFar = 1e30F; ///< bounds of unused boxes: they end before they begin

  float bounds[2][3][kSize];                 ///< lower and upper ones
  std::array<std::uint32_t, kSize> children; ///< a treelet, a leaf, or kEmpty
  /// For each octant of directions (bit i: component i is negative) the children from far to near.
  /// There is such an order because the cells of a kd-tree do not overlap.
  alignas(16) std::uint8_t farToNear[8][kSize];
};

}

#endif
