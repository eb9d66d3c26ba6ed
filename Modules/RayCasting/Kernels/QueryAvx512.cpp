// SPDX-License-Identifier: BSD-3-Clause
#ifdef __x86_64__

#include "Kernels/CountedBlocks.h"
#include "Kernels/FrontStages.h"
#include "Simd/SimdTarget.h"
#include "Trees/KdTreeBuilder.h"

#include <algorithm>
#include <cstring>
#include <immintrin.h>

IRRADIANCE_TARGET_BEGIN(IRRADIANCE_AVX512)

#include "Kernels/Avx2Lanes.inl"
#include "Kernels/FrontStages.inl"

namespace irradiance
{
namespace
{

/// All 16 boxes of a treelet at once.
struct Avx512Boxes
{
  using Floats = __m512;
  using Mask = __mmask16;
  static constexpr unsigned kCount = 16;

  static Floats all(float value) { return _mm512_set1_ps(value); }
  static Floats load(const float* values) { return _mm512_load_ps(values); }
  static void store(float* values, Floats x) { _mm512_store_ps(values, x); }
  static Floats mulAdd(Floats a, Floats b, Floats c) { return _mm512_fmadd_ps(a, b, c); }
  static Floats mulSubtract(Floats a, Floats b, Floats c) { return _mm512_fmsub_ps(a, b, c); }
  static Floats least(Floats a, Floats b) { return _mm512_min_ps(a, b); }
  static Floats most(Floats a, Floats b) { return _mm512_max_ps(a, b); }
  static Floats flip(Floats x, Floats sign) { return _mm512_xor_ps(x, sign); }
  static Mask isLess(Floats a, Floats b) { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ); }
  static Mask isAtMost(Floats a, Floats b) { return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ); }
  static Mask both(Mask a, Mask b) { return _kand_mask16(a, b); }
  static unsigned bits(Mask mask) { return mask; }
  static unsigned ordered(const Mask (&passed)[1], const std::uint8_t* order)
  {
    const __m128i places = _mm_load_si128(reinterpret_cast<const __m128i*>(order));
    return static_cast<unsigned>(
      _mm_movemask_epi8(_mm_shuffle_epi8(_mm_movm_epi8(passed[0]), places)));
  }
};

}

const FrontStages& frontStagesAvx512()
{
  return kStages<Avx512Boxes, Avx2Lanes>;
}

}

IRRADIANCE_TARGET_END

#endif
