// SPDX-License-Identifier: BSD-3-Clause
#ifdef __x86_64__

#include "History/PointScan.h"
#include "History/WalkBlock.h"
#include "Simd/Prefetch.h"
#include "Simd/SimdTarget.h"

#include <algorithm>
#include <immintrin.h>

IRRADIANCE_TARGET_BEGIN(IRRADIANCE_AVX2)

#include "History/WideScan.inl"

namespace irradiance
{
namespace
{

struct Avx2Lanes
{
  using Floats = __m256;
  static constexpr std::size_t kCount = 8;

  static Floats all(float value) { return _mm256_set1_ps(value); }
  static Floats load(const float* values) { return _mm256_loadu_ps(values); }
  static Floats mulAdd(Floats a, Floats b, Floats c) { return _mm256_fmadd_ps(a, b, c); }
  static Floats subtractMul(Floats a, Floats b, Floats c) { return _mm256_fnmadd_ps(b, c, a); }
  static Floats least(Floats a, Floats b) { return _mm256_min_ps(a, b); }
  static Floats most(Floats a, Floats b) { return _mm256_max_ps(a, b); }
  static Floats isLess(Floats a, Floats b) { return _mm256_cmp_ps(a, b, _CMP_LT_OQ); }
  static Floats choose(Floats first, Floats a, Floats b) { return _mm256_blendv_ps(b, a, first); }
  /// NaN counts as not above.
  static unsigned notAbove(Floats a, Floats b)
  {
    return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_NGT_UQ)));
  }
  static unsigned tagged(const std::uint16_t* tags, std::uint32_t set)
  {
    const __m256i all =
      _mm256_cvtepu16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(tags)));
    const __m256i bits = _mm256_srlv_epi32(
      _mm256_set1_epi32(static_cast<int>(set)), _mm256_srli_epi32(all, WalkBlock::kTagShift));
    constexpr int kToSign = 31;
    return static_cast<unsigned>(
      _mm256_movemask_ps(_mm256_castsi256_ps(_mm256_slli_epi32(bits, kToSign))));
  }
};

}

void runScanAvx2(const PointScan& scan)
{
  runScan<Avx2Lanes>(scan);
}

}

IRRADIANCE_TARGET_END

#endif
