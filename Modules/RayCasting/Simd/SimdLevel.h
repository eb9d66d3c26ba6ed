// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

namespace irradiance
{

/// The instruction set that searches use. The hits found are the same, bit for bit.
enum class SimdLevel
{
  Plain, ///< any machine
  Avx2,  ///< x86-64 with AVX2 and FMA
  Avx512 ///< x86-64 with AVX-512 F, VL, BW and DQ
};

/// The best level of this machine.
inline SimdLevel simdLevelOfMachine()
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

inline SimdLevel& limitedSimdLevel()
{
  static SimdLevel level = simdLevelOfMachine();
  return level;
}
/// That level, or the limit set by limitSimd() if that is lower.
inline SimdLevel simdLevel()
{
  return limitedSimdLevel();
}
/// For tests and benchmarks. Must not be called while other threads compute.
inline void limitSimd(SimdLevel limit)
{
  limitedSimdLevel() = std::min(limit, simdLevelOfMachine());
}

}

/// Calls the best of `name`Avx512, `name`Avx2 and `name`Plain that the machine can run.
#ifdef __x86_64__
#define IRRADIANCE_CALL_BEST(name, ...)                                                            \
  (simdLevel() == SimdLevel::Avx512    ? name##Avx512                                              \
      : simdLevel() == SimdLevel::Avx2 ? name##Avx2                                                \
                                       : name##Plain)(__VA_ARGS__)
#else
#define IRRADIANCE_CALL_BEST(name, ...) name##Plain(__VA_ARGS__)
#endif
