// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_StaleMark_h
#define irradiance_StaleMark_h

#include "History/SegmentRef.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace irradiance
{

/// From this segment on a stored walk is no longer valid, and it has not been shot again yet. The
/// ray of the segment and all before it are valid.
struct StaleMark
{
  std::uint32_t walk;
  std::uint32_t bounce : 21;     ///< a walk has at most 2^20 segments
  std::uint32_t powerClass : 11; ///< what it carries: more if larger, 0: repaired
  std::int64_t gain;             ///< see TailBound

  SegmentRef first() const { return { walk, bounce }; }
};

/// The marks of a block, ordered by walk, at most one per walk.
using StaleMarks = std::vector<StaleMark>;

inline bool isStale(const StaleMarks& marks, const SegmentRef& segment)
{
  const auto found = std::lower_bound(marks.begin(), marks.end(), segment.walk,
    [](const StaleMark& mark, std::uint32_t walk) { return mark.walk < walk; });
  return found != marks.end() && found->walk == segment.walk && segment.bounce >= found->bounce;
}

}

#endif
