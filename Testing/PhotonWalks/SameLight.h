// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_test_SameLight_h
#define irradiance_test_SameLight_h

#include "Views/SensorGather.h"

#include <cstring>
#include <vector>

namespace irradiance::test
{

/// Bit for bit.
inline bool areSame(
  const std::vector<SensorGather::Light>& a, const std::vector<SensorGather::Light>& b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

}

#endif
