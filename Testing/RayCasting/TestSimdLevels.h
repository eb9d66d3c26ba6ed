// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Simd/SimdLevel.h"

#include <vector>

namespace irradiance::test
{

/// During its lifetime at most this level is used.
class SimdLimit
{
public:
  explicit SimdLimit(SimdLevel limit) { limitSimd(limit); }
  ~SimdLimit() { limitSimd(SimdLevel::Avx512); }
  SimdLimit(const SimdLimit&) = delete;
  SimdLimit& operator=(const SimdLimit&) = delete;
};

/// All levels that this machine supports.
inline std::vector<SimdLevel> simdLevels()
{
  std::vector<SimdLevel> levels;
  for (const SimdLevel level : { SimdLevel::Plain, SimdLevel::Avx2, SimdLevel::Avx512 })
  {
    if (level <= simdLevel())
    {
      levels.push_back(level);
    }
  }
  return levels;
}

}
