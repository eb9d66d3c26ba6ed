// SPDX-License-Identifier: BSD-3-Clause
#ifdef __x86_64__

#include "History/GridSegments.h"
#include "History/PageScan.h"
#include "Simd/Prefetch.h"
#include "Simd/SimdTarget.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <immintrin.h>

IRRADIANCE_TARGET_BEGIN(IRRADIANCE_AVX2)

#include "History/GridSegments.inl"
#include "History/PageScan.inl"
#include "History/WideTags.inl"

namespace irradiance
{
namespace
{

struct Avx2ShortLanes
{
  static constexpr std::size_t kCount = 16;

  static __m256i all(std::uint32_t twice) { return _mm256_set1_epi32(static_cast<int>(twice)); }
  static __m256i load(const std::int16_t* values)
  {
    return _mm256_load_si256(reinterpret_cast<const __m256i*>(values));
  }
  /// Divided by 2^15.
  static __m256i multiply(__m256i a, __m256i b) { return _mm256_mulhrs_epi16(a, b); }
  static __m256i add(__m256i a, __m256i b) { return _mm256_add_epi16(a, b); }
  static __m256i subtract(__m256i a, __m256i b) { return _mm256_sub_epi16(a, b); }
  static __m256i most(__m256i a, __m256i b) { return _mm256_max_epi16(a, b); }
  static __m256i absolute(__m256i a) { return _mm256_abs_epi16(a); }
  static unsigned notAbove(__m256i a, __m256i b)
  {
    const __m256i above = _mm256_cmpgt_epi16(a, b);
    constexpr unsigned kAll = 0xffff;
    return kAll ^
      static_cast<unsigned>(_mm_movemask_epi8(
        _mm_packs_epi16(_mm256_castsi256_si128(above), _mm256_extracti128_si256(above, 1))));
  }
};

struct Avx2GridLanes : WideTags
{
  using Shorts = Avx2ShortLanes;
  using Floats = __m256;
  static constexpr std::size_t kCount = 8;

  static Floats all(float value) { return _mm256_set1_ps(value); }
  static Floats load(const std::int16_t* places)
  {
    const __m128i all = _mm_loadu_si128(reinterpret_cast<const __m128i*>(places));
    return _mm256_cvtepi32_ps(_mm256_cvtepi16_epi32(all));
  }
  static Floats add(Floats a, Floats b) { return _mm256_add_ps(a, b); }
  static Floats subtract(Floats a, Floats b) { return _mm256_sub_ps(a, b); }
  static Floats multiply(Floats a, Floats b) { return _mm256_mul_ps(a, b); }
  static Floats divide(Floats a, Floats b) { return _mm256_div_ps(a, b); }
  static Floats least(Floats a, Floats b) { return _mm256_min_ps(a, b); }
  static Floats most(Floats a, Floats b) { return _mm256_max_ps(a, b); }
  static Floats absolute(Floats a) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a); }
  /// NaN counts as not above.
  static unsigned notAbove(Floats a, Floats b)
  {
    return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_NGT_UQ)));
  }
};

}

void scanPagesAvx2(const PageScan& scan)
{
  scanPages<Avx2GridLanes>(scan);
}

void placeOnGridAvx2(const PointGrid& grid, const RayColumns& rays, std::size_t first,
  std::size_t count, GridSegments& segments)
{
  placeAllOnGrid(grid, rays, first, count, segments);
}

}

IRRADIANCE_TARGET_END

#endif
