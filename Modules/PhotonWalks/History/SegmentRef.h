// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SegmentRef_h
#define irradiance_SegmentRef_h

#include <cstdint>
#include <tuple>

namespace irradiance
{

/// Which segment of which walk; also the photon that the segment brings to what it hits.
struct SegmentRef
{
  std::uint32_t walk;   ///< its number in the plan
  std::uint32_t bounce; ///< 0 for the segment that leaves the light

  friend bool operator==(const SegmentRef& a, const SegmentRef& b)
  {
    return a.walk == b.walk && a.bounce == b.bounce;
  }
  friend bool operator<(const SegmentRef& a, const SegmentRef& b)
  {
    return std::tie(a.walk, a.bounce) < std::tie(b.walk, b.bounce);
  }
};

}

#endif
