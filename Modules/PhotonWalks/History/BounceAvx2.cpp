// SPDX-License-Identifier: BSD-3-Clause
#ifdef __x86_64__

#include "History/PageScan.h"
#include "Simd/Prefetch.h"
#include "Simd/SimdTarget.h"

#include <algorithm>
#include <cstring>
#include <immintrin.h>

IRRADIANCE_TARGET_BEGIN(IRRADIANCE_AVX2)

#include "History/WideTags.inl"

namespace irradiance
{
namespace
{

/// Floats and whole numbers of 16 bits, side by side.
struct GridLanes : WideTags
{
  using Floats = __m256;
  using Shorts = __m256i;
  static constexpr std::size_t kFloats = 8, kShorts = 16;

  static Floats all(float value) { return _mm256_set1_ps(value); }
  static Floats load(const std::int16_t* places)
  {
    const __m128i all = _mm_loadu_si128(reinterpret_cast<const __m128i*>(places));
    return _mm256_cvtepi32_ps(_mm256_cvtepi16_epi32(all));
  }
  static Floats least(Floats a, Floats b) { return _mm256_min_ps(a, b); }
  static Floats most(Floats a, Floats b) { return _mm256_max_ps(a, b); }
  static Floats absolute(Floats a) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a); }
  /// NaN counts as not above.
  static unsigned notAbove(Floats a, Floats b)
  {
    return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_NGT_UQ)));
  }

  static Shorts allShorts(std::uint32_t twice)
  {
    return _mm256_set1_epi32(static_cast<int>(twice));
  }
  static Shorts loadShorts(const std::int16_t* values)
  {
    return _mm256_load_si256(reinterpret_cast<const __m256i*>(values));
  }
  /// Divided by 2^15.
  static Shorts multiply(Shorts a, Shorts b) { return _mm256_mulhrs_epi16(a, b); }
  static Shorts add(Shorts a, Shorts b) { return _mm256_add_epi16(a, b); }
  static Shorts subtract(Shorts a, Shorts b) { return _mm256_sub_epi16(a, b); }
  static Shorts most(Shorts a, Shorts b) { return _mm256_max_epi16(a, b); }
  static Shorts absolute(Shorts a) { return _mm256_abs_epi16(a); }
  static unsigned notAbove(Shorts a, Shorts b)
  {
    const __m256i above = _mm256_cmpgt_epi16(a, b);
    constexpr unsigned kAll = 0xffff;
    return kAll ^
      static_cast<unsigned>(_mm_movemask_epi8(
        _mm_packs_epi16(_mm256_castsi256_si128(above), _mm256_extracti128_si256(above, 1))));
  }
};

}
}

#include "History/GridSegments.inl"
#include "History/PageScan.inl"

namespace irradiance
{

const BounceLoops& bounceLoopsAvx2()
{
  return kLoops;
}

}

IRRADIANCE_TARGET_END

#endif
