// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "History/BouncePage.h"
#include "History/GridBody.h"
#include "Simd/SimdLevel.h"

#include <cstddef>
#include <cstdint>

namespace irradiance
{

/// Which tags are flagged.
struct TagSet
{
  std::uint8_t rows[16] = {}; ///< kind k has bit k / 16 of rows[k % 16]
  std::uint8_t open = 0;      ///< BounceTag::kOpen if all open segments are flagged

  void add(std::uint8_t kind)
  {
    std::uint8_t& row = rows[kind % 16];
    row = static_cast<std::uint8_t>(row | 1u << kind / 16);
  }
  bool has(std::uint8_t tag) const
  {
    const unsigned kind = tag & BounceTag::kKinds;
    return (rows[kind % 16] >> kind / 16 & 1) != 0 || (tag & open) != 0;
  }
};

/// A body, and which of some segments may come near its ball, a bit for each.
struct NearBody
{
  std::uint32_t body;
  unsigned lanes;
};

/// What the loops of a BounceScan work on: they test each segment of some pages once.
struct PageScan
{
  static constexpr std::uint32_t kGroupSize = 16; ///< segments to a word of `flagged`
  static constexpr std::size_t kMostParts = 2;    ///< groups whose lines are tested together
  static constexpr std::uint32_t kGroups = BouncePage::kSize / kGroupSize;

  const BouncePage* const* pages;
  std::size_t numberOfPages;
  const BouncePage* next; ///< is scanned afterwards, to be prefetched; may be null
  TagSet tags;
  const GridBody* bodies; ///< that moved
  const GridBall* balls;  ///< around these
  std::uint32_t numberOfBodies;
  bool areSmall;        ///< some are, so balls are worth testing
  const float* stretch; ///< of the grid along each axis, see GridBall
  NearBody* near;       ///< room for kMostParts times as many; of no meaning outside
  /// A bit for each slot, kGroups words for each page: set if a segment is stored there that may
  /// touch a body, or whose tag is in `tags`. The same on every machine.
  std::uint16_t* flagged;
};

/// The loops over segments of one instruction set. All sets give the same bits.
struct BounceLoops
{
  void (*scanPages)(const PageScan& scan);
  /// Rays [first, first + count), at most GridSegments::kSize.
  void (*placeOnGrid)(const PointGrid& grid, const RayColumns& rays, std::size_t first,
    std::size_t count, GridSegments& segments);
};

const BounceLoops& bounceLoopsPlain();
const BounceLoops& bounceLoopsAvx2();
const BounceLoops& bounceLoopsAvx512();
/// With the best instructions of the machine.
inline const BounceLoops& bounceLoops()
{
  return IRRADIANCE_CALL_BEST(bounceLoops, );
}

}
