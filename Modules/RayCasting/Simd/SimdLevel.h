// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SimdLevel_h
#define irradiance_SimdLevel_h

namespace irradiance
{

/// The instruction set that searches use. The hits found are the same, bit for bit.
enum class SimdLevel
{
  Plain, ///< any machine
  Avx2,  ///< x86-64 with AVX2 and FMA
  Avx512 ///< x86-64 with AVX-512 F, VL, BW and DQ
};

/// The best level of this machine, or the limit set by limitSimd() if that is lower.
SimdLevel simdLevel();

/// For tests and benchmarks. Must not be called while other threads compute.
void limitSimd(SimdLevel limit);

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

#endif
