// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Contribution_h
#define irradiance_Contribution_h

#include "History/WalkBlock.h"

namespace irradiance
{

/// What a stored segment brings to the cell that it hits: all that it carries.
struct Contribution
{
  SegmentRef segment;
  Hit hit; ///< without its distance
  bool isFront;
  Power power;
};

/// Calls visit(Contribution) for each segment of a walk from `first` up to bounce `end` that hits
/// something, in order. What takes sums back, counts stale light or lists photons asks here.
template <class Visit>
void forEachContribution(
  const WalkBlock& block, const SegmentRef& first, std::uint32_t end, const Visit& visit)
{
  for (SegmentRef segment = first; segment.bounce < end; ++segment.bounce)
  {
    if (const Hit hit = block.hit(segment))
    {
      visit(Contribution{ segment, hit, block.isFront(segment), block.power(segment) });
    }
  }
}

}

#endif
