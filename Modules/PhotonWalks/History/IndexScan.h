// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_IndexScan_h
#define irradiance_IndexScan_h

#include "History/PageScan.h"

#include <cstddef>
#include <cstdint>

namespace irradiance
{

/// Segments or groups of them, in columns: ends as in BouncePage.
struct IndexColumns
{
  const std::int16_t* ends[6];
  const float*
    radius; ///< of groups: no end of the group's segments is farther from that of these; in steps
};

/// What the loops of a SegmentIndex work on. Every kFanout entries of a level have one in the next.
struct IndexScan
{
  static constexpr std::size_t kFanout = 16;

  IndexColumns segments, groups, tops;
  std::size_t numberOfTops; ///< a multiple of kFanout; with as many groups and segments as follows
  /// Segments in no order, with no groups.
  IndexColumns tail;
  std::size_t numberInTail; ///< a multiple of kFanout
  GridBodies bodies;
  // For each body, of no meaning outside.
  std::uint16_t *nearTops, *nearGroups;
  std::uint32_t *bodiesOfTop, *bodiesOfGroup;
  NearBody* near;
  /// The segments that may touch a body: by number, first those with groups, then those of the tail.
  std::uint32_t* found;
};

/// Returns how many were found.
std::size_t scanIndexPlain(const IndexScan& scan);
#ifdef __x86_64__
std::size_t scanIndexAvx2(const IndexScan& scan);
std::size_t scanIndexAvx512(const IndexScan& scan);
#endif

}

#endif
