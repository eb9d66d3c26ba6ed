// SPDX-License-Identifier: BSD-3-Clause
#ifdef __x86_64__

#include "History/PageScan.h"
#include "Simd/Prefetch.h"
#include "Simd/SimdTarget.h"

#include <algorithm>
#include <cstring>
#include <immintrin.h>

IRRADIANCE_TARGET_BEGIN(IRRADIANCE_AVX512)

#include "History/WideTags.inl"

namespace irradiance
{
namespace
{

/// Floats and whole numbers of 16 bits, side by side.
struct GridLanes : WideTags
{
  using Floats = __m512;
  using Shorts = __m512i;
  static constexpr std::size_t kFloats = 16, kShorts = 32;

  static Floats all(float value) { return _mm512_set1_ps(value); }
  static Floats load(const std::int16_t* places)
  {
    const __m256i all = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(places));
    return _mm512_cvtepi32_ps(_mm512_cvtepi16_epi32(all));
  }
  static Floats least(Floats a, Floats b) { return _mm512_min_ps(a, b); }
  static Floats most(Floats a, Floats b) { return _mm512_max_ps(a, b); }
  static Floats absolute(Floats a) { return _mm512_abs_ps(a); }
  /// NaN counts as not above.
  static unsigned notAbove(Floats a, Floats b) { return _mm512_cmp_ps_mask(a, b, _CMP_NGT_UQ); }

  static Shorts allShorts(std::uint32_t twice)
  {
    return _mm512_set1_epi32(static_cast<int>(twice));
  }
  static Shorts loadShorts(const std::int16_t* values) { return _mm512_load_si512(values); }
  /// Divided by 2^15.
  static Shorts multiply(Shorts a, Shorts b) { return _mm512_mulhrs_epi16(a, b); }
  static Shorts add(Shorts a, Shorts b) { return _mm512_add_epi16(a, b); }
  static Shorts subtract(Shorts a, Shorts b) { return _mm512_sub_epi16(a, b); }
  static Shorts most(Shorts a, Shorts b) { return _mm512_max_epi16(a, b); }
  static Shorts absolute(Shorts a) { return _mm512_abs_epi16(a); }
  static unsigned notAbove(Shorts a, Shorts b) { return _mm512_cmple_epi16_mask(a, b); }
};

}
}

#include "History/GridSegments.inl"
#include "History/PageScan.inl"

namespace irradiance
{

const BounceLoops& bounceLoopsAvx512()
{
  return kLoops;
}

}

IRRADIANCE_TARGET_END

#endif
