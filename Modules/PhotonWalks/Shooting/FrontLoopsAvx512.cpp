// SPDX-License-Identifier: BSD-3-Clause
#ifdef __x86_64__

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

  static void transpose(const double* const* rows, double* columns)
  {
    for (unsigned column = 0; column < RecordLanes::kColumns; column += 8)
    {
      transposeSquare(rows, column, columns + std::size_t{ column } * kGroup);
    }
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

private:
  static void transposeSquare(const double* const* rows, unsigned first, double* columns)
  {
    // Pairs of rows: columns 0, 2, 4, 6 of both in `even`, the others in `odd`.
    __m512d even[4], odd[4];
    for (std::size_t pair = 0; pair < 4; ++pair)
    {
      const __m512d a = _mm512_load_pd(rows[2 * pair] + first),
                    b = _mm512_load_pd(rows[2 * pair + 1] + first);
      even[pair] = _mm512_unpacklo_pd(a, b);
      odd[pair] = _mm512_unpackhi_pd(a, b);
    }
    storeEverySecond(even, columns);
    storeEverySecond(odd, columns + kGroup);
  }
  static void storeEverySecond(const __m512d (&pairs)[4], double* columns)
  {
    // 0x88 takes the quarters 0 and 2 of both, 0xdd the quarters 1 and 3.
    const __m512d above = _mm512_shuffle_f64x2(pairs[0], pairs[1], 0x88),
                  below = _mm512_shuffle_f64x2(pairs[2], pairs[3], 0x88),
                  aboveNext = _mm512_shuffle_f64x2(pairs[0], pairs[1], 0xdd),
                  belowNext = _mm512_shuffle_f64x2(pairs[2], pairs[3], 0xdd);
    _mm512_store_pd(columns, _mm512_shuffle_f64x2(above, below, 0x88));
    _mm512_store_pd(
      columns + std::size_t{ 2 } * kGroup, _mm512_shuffle_f64x2(aboveNext, belowNext, 0x88));
    _mm512_store_pd(columns + std::size_t{ 4 } * kGroup, _mm512_shuffle_f64x2(above, below, 0xdd));
    _mm512_store_pd(
      columns + std::size_t{ 6 } * kGroup, _mm512_shuffle_f64x2(aboveNext, belowNext, 0xdd));
  }
};

}

const FrontLoops& frontLoopsAvx512()
{
  return kLoops<Avx512Lanes>;
}

}

IRRADIANCE_TARGET_END

#endif
