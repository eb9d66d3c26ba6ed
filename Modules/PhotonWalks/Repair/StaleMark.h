// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_StaleMark_h
#define irradiance_StaleMark_h

#include "History/WalkBlock.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace irradiance
{

/// From this segment on a stored walk is no longer valid, and it has not been shot again yet. The
/// ray of the segment and all before it are valid.
struct StaleMark
{
  std::uint16_t walkInBlock;
  std::uint16_t effect; ///< class of the power that it carries; larger is more, 0: repaired
  std::uint32_t bounce;
  std::int64_t gain; ///< see TailBound
};

/// The marks of a block, ordered by walk, at most one per walk.
using StaleMarks = std::vector<StaleMark>;

inline bool isStale(const StaleMarks& marks, const WalkBlock::Place& place)
{
  const auto found = std::lower_bound(marks.begin(), marks.end(), place.walk,
    [](const StaleMark& mark, std::uint32_t walk) { return mark.walkInBlock < walk; });
  return found != marks.end() && found->walkInBlock == place.walk && place.bounce >= found->bounce;
}

}

#endif
