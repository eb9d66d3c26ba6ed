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

IRRADIANCE_TARGET_BEGIN(IRRADIANCE_AVX512)

#include "History/GridSegments.inl"
#include "History/PageScan.inl"
#include "History/WideTags.inl"

namespace irradiance
{
namespace
{

struct Avx512ShortLanes
{
  static constexpr std::size_t kCount = 32;

  static __m512i all(std::uint32_t twice) { return _mm512_set1_epi32(static_cast<int>(twice)); }
  static __m512i load(const std::int16_t* values) { return _mm512_load_si512(values); }
  /// Divided by 2^15.
  static __m512i multiply(__m512i a, __m512i b) { return _mm512_mulhrs_epi16(a, b); }
  static __m512i add(__m512i a, __m512i b) { return _mm512_add_epi16(a, b); }
  static __m512i subtract(__m512i a, __m512i b) { return _mm512_sub_epi16(a, b); }
  static __m512i most(__m512i a, __m512i b) { return _mm512_max_epi16(a, b); }
  static __m512i absolute(__m512i a) { return _mm512_abs_epi16(a); }
  static unsigned notAbove(__m512i a, __m512i b) { return _mm512_cmple_epi16_mask(a, b); }
};

struct Avx512GridLanes : WideTags
{
  using Shorts = Avx512ShortLanes;
  using Floats = __m512;
  static constexpr std::size_t kCount = 16;

  static Floats all(float value) { return _mm512_set1_ps(value); }
  static Floats load(const std::int16_t* places)
  {
    const __m256i all = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(places));
    return _mm512_cvtepi32_ps(_mm512_cvtepi16_epi32(all));
  }
  static Floats add(Floats a, Floats b) { return _mm512_add_ps(a, b); }
  static Floats subtract(Floats a, Floats b) { return _mm512_sub_ps(a, b); }
  static Floats multiply(Floats a, Floats b) { return _mm512_mul_ps(a, b); }
  static Floats divide(Floats a, Floats b) { return _mm512_div_ps(a, b); }
  static Floats least(Floats a, Floats b) { return _mm512_min_ps(a, b); }
  static Floats most(Floats a, Floats b) { return _mm512_max_ps(a, b); }
  static Floats absolute(Floats a) { return _mm512_abs_ps(a); }
  /// NaN counts as not above.
  static unsigned notAbove(Floats a, Floats b) { return _mm512_cmp_ps_mask(a, b, _CMP_NGT_UQ); }
};

}

void scanPagesAvx512(const PageScan& scan)
{
  scanPages<Avx512GridLanes>(scan);
}

void placeOnGridAvx512(const PointGrid& grid, const RayColumns& rays, std::size_t first,
  std::size_t count, GridSegments& segments)
{
  placeAllOnGrid(grid, rays, first, count, segments);
}

}

IRRADIANCE_TARGET_END

#endif
