// SPDX-License-Identifier: BSD-3-Clause
#ifdef __x86_64__

#include "Kernels/PrepareLanes.h"
#include "Sampling/DirectionSampling.h"
#include "Shooting/FrontLoops.h"
#include "Simd/Prefetch.h"
#include "Simd/SimdTarget.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <immintrin.h>

IRRADIANCE_TARGET_BEGIN(IRRADIANCE_AVX512)

#include "Shooting/FrontLoops.inl"

namespace irradiance
{
namespace
{

struct Avx512Lanes
{
  static std::uint32_t maskOf(const std::uint32_t* flags)
  {
    const __m512i low = _mm512_load_si512(flags), high = _mm512_load_si512(flags + 16);
    return std::uint32_t{ _mm512_test_epi32_mask(low, low) } |
      std::uint32_t{ _mm512_test_epi32_mask(high, high) } << 16;
  }

  static void transpose(const double* const (&rows)[4], double* const (&columns)[4])
  {
    transpose4(rows, columns);
  }

  class Packing
  {
  public:
    explicit Packing(unsigned mask)
      : all_(static_cast<__mmask16>(mask))
      , low_(static_cast<__mmask8>(mask))
      , high_(static_cast<__mmask8>(mask >> 8))
      , lows_(__builtin_popcount(mask & 0xffu))
    {
    }

    /// Values of one word or two.
    template <class Value>
    void operator()(const Value* from, Value* to) const
    {
      if constexpr (sizeof(Value) == 4)
      {
        _mm512_storeu_si512(to, packed(_mm512_load_si512(from)));
      }
      else
      {
        _mm512_storeu_si512(to, _mm512_maskz_compress_epi64(low_, _mm512_load_si512(from)));
        _mm512_storeu_si512(
          to + lows_, _mm512_maskz_compress_epi64(high_, _mm512_load_si512(from + 8)));
      }
    }
    void operator()(const std::uint8_t* from, std::uint8_t* to) const
    {
      const __m512i words =
        _mm512_cvtepu8_epi32(_mm_load_si128(reinterpret_cast<const __m128i*>(from)));
      _mm_storeu_si128(reinterpret_cast<__m128i*>(to), _mm512_cvtepi32_epi8(packed(words)));
    }

  private:
    __m512i packed(__m512i words) const { return _mm512_maskz_compress_epi32(all_, words); }

    __mmask16 all_;
    __mmask8 low_, high_;
    int lows_; ///< how many of the first eight stay
  };
};

}

const FrontLoops& frontLoopsAvx512()
{
  return kLoops<Avx512Lanes>;
}

}

IRRADIANCE_TARGET_END

#endif
