// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Ray.h"

#include <cstddef>
#include <cstdint>

namespace irradiance
{

/// What a scan must know of a stored segment besides its ends, in a byte.
struct BounceTag
{
  static constexpr std::uint8_t kFree = 0xff; ///< no segment is stored there
  /// It is not whole within the grid: it escapes, or was cut.
  static constexpr std::uint8_t kOpen = 0x80;
  static constexpr std::uint8_t kKinds = 0x7f; ///< the bits that hold one of the following
  /// The rays of these are always cast again: contacts, and what is too far away for the grid.
  static constexpr std::uint8_t kAlways = 126;
  static constexpr std::uint8_t kObjects = 125; ///< kinds of dynamic objects: 1 to this

  /// The kind of a segment that hits this object: 0 for the static one and for escapes. Several
  /// dynamic objects may share a kind.
  static std::uint8_t kindOf(std::uint32_t object)
  {
    return object == 0 || object == TriangleId::kNone
      ? std::uint8_t{ 0 }
      : static_cast<std::uint8_t>(1 + (object - 1) % kObjects);
  }
};

/// What cannot be computed again of a stored segment.
struct BounceRecord
{
  static constexpr std::uint16_t kWalk = 0x3ff; ///< counted from the first of the block
  static constexpr std::uint16_t kBack = 0x400; ///< the side that was hit
  static constexpr std::uint16_t kContact = 0x800;

  std::uint32_t triangle; ///< that was hit, numbered through all objects
  float weights[2];       ///< see Hit
  std::uint16_t walk;     ///< with the flags above
  std::uint16_t parent;   ///< see BounceBlock
};
static_assert(sizeof(BounceRecord) == 16);

/// The places of 256 segments, in columns. What a scan reads comes first, and lies together. With
/// several bands their powers follow the page.
struct BouncePage
{
  static constexpr std::uint32_t kSize = 256;

  std::int16_t ends[6][kSize]; ///< on the grid: where it begins, then where it ends; by axis
  std::uint8_t tags[kSize];    ///< see BounceTag
  std::uint8_t bounces[kSize]; ///< 255 stands for that or more
  std::uint16_t children[kSize];
  BounceRecord records[kSize];

  static constexpr std::size_t kScanned = sizeof ends + sizeof tags; ///< bytes
};
static_assert(sizeof(BouncePage) == std::size_t{ 32 } * BouncePage::kSize);

}
