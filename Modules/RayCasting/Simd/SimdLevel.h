// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SimdLevel_h
#define irradiance_SimdLevel_h

namespace irradiance
{

/// The instructions that searches are made of. What they find is the same, bit for bit.
enum class SimdLevel
{
  Plain, ///< any machine
  Avx2,  ///< x86-64 with AVX2 and FMA
  Avx512 ///< x86-64 with AVX-512 F, VL, BW and DQ
};

/// The best level of this machine, or the limit if that is lower.
SimdLevel simdLevel();

/// For tests and benchmarks; not to be called while others compute.
void limitSimd(SimdLevel limit);

}

#endif
