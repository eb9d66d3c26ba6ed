// SPDX-License-Identifier: BSD-3-Clause
#include "Simd/SimdLevel.h"

#include <algorithm>

namespace irradiance
{

namespace
{

SimdLevel detect()
{
#ifdef __x86_64__
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma"))
  {
    return SimdLevel::Plain;
  }
  const bool isWide = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
    __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq");
  return isWide ? SimdLevel::Avx512 : SimdLevel::Avx2;
#else
  return SimdLevel::Plain;
#endif
}

SimdLevel& currentLevel()
{
  static SimdLevel level = detect();
  return level;
}

}

SimdLevel simdLevel()
{
  return currentLevel();
}

void limitSimd(SimdLevel limit)
{
  currentLevel() = std::min(limit, detect());
}

}
