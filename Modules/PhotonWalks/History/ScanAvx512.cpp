// SPDX-License-Identifier: BSD-3-Clause
#ifdef __x86_64__

#include "History/PointScan.h"
#include "History/WalkBlock.h"
#include "Simd/Prefetch.h"
#include "Simd/SimdTarget.h"

#include <algorithm>
#include <immintrin.h>

IRRADIANCE_TARGET_BEGIN(IRRADIANCE_AVX512)

#include "History/WideScan.inl"

namespace irradiance
{
namespace
{

struct Avx512Lanes
{
  using Floats = __m512;
  static constexpr std::size_t kCount = 16;

  static Floats all(float value) { return _mm512_set1_ps(value); }
  static Floats load(const float* values) { return _mm512_loadu_ps(values); }
  static Floats mulAdd(Floats a, Floats b, Floats c) { return _mm512_fmadd_ps(a, b, c); }
  static Floats subtractMul(Floats a, Floats b, Floats c) { return _mm512_fnmadd_ps(b, c, a); }
  static Floats least(Floats a, Floats b) { return _mm512_min_ps(a, b); }
  static Floats most(Floats a, Floats b) { return _mm512_max_ps(a, b); }
  static __mmask16 isLess(Floats a, Floats b) { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ); }
  static Floats choose(__mmask16 first, Floats a, Floats b)
  {
    return _mm512_mask_blend_ps(first, b, a);
  }
  /// NaN counts as not above.
  static unsigned notAbove(Floats a, Floats b) { return _mm512_cmp_ps_mask(a, b, _CMP_NGT_UQ); }
  static unsigned tagged(const std::uint16_t* tags, std::uint32_t set)
  {
    const __m512i all =
      _mm512_cvtepu16_epi32(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(tags)));
    const __m512i bits = _mm512_srlv_epi32(
      _mm512_set1_epi32(static_cast<int>(set)), _mm512_srli_epi32(all, WalkBlock::kTagShift));
    return _mm512_test_epi32_mask(bits, _mm512_set1_epi32(1));
  }
};

}

void runScanAvx512(const PointScan& scan)
{
  runScan<Avx512Lanes>(scan);
}

}

IRRADIANCE_TARGET_END

#endif
