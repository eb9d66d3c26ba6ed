// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_FewestSamples_h
#define irradiance_FewestSamples_h

#include <cstdint>

namespace irradiance
{

/// With how many samples cells gather direct light at least; rounded up.
struct FewestSamples
{
  std::uint32_t small = 4; ///< >= 1
  std::uint32_t large = 4; ///< of cells that may receive four walks or more for each of `small`

  friend bool operator==(const FewestSamples& a, const FewestSamples& b)
  {
    return a.small == b.small && a.large == b.large;
  }
};

}

#endif
