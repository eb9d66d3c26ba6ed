// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_RepairedTail_h
#define irradiance_RepairedTail_h

#include <cstdint>

namespace irradiance
{

/// A walk was shot again from this segment on.
struct RepairedTail
{
  std::uint32_t walk, bounce;

  friend bool operator<(const RepairedTail& a, const RepairedTail& b) { return a.walk < b.walk; }
};

}

#endif
