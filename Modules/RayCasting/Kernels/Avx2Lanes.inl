// SPDX-License-Identifier: BSD-3-Clause
// No include guard: the kernels for AVX2 and AVX-512 include it once each, between the marks of
// their targets.

namespace irradiance
{
namespace
{

struct Avx2Lanes
{
  using Floats = __m256;
  using Mask = __m256;
  static constexpr unsigned kCount = 8;

  static Floats all(float value) { return _mm256_set1_ps(value); }
  static Floats load(const float* values) { return _mm256_load_ps(values); }
  static void store(float* values, Floats x) { _mm256_store_ps(values, x); }
  static Floats mulAdd(Floats a, Floats b, Floats c) { return _mm256_fmadd_ps(a, b, c); }
  static Floats mulSubtract(Floats a, Floats b, Floats c) { return _mm256_fmsub_ps(a, b, c); }
  static Floats least(Floats a, Floats b) { return _mm256_min_ps(a, b); }
  static Floats most(Floats a, Floats b) { return _mm256_max_ps(a, b); }
  static Floats absolute(Floats x) { return _mm256_andnot_ps(all(-0.0F), x); }
  static Floats signOf(Floats x) { return _mm256_and_ps(all(-0.0F), x); }
  static Floats flip(Floats x, Floats sign) { return _mm256_xor_ps(x, sign); }
  static Mask isLess(Floats a, Floats b) { return _mm256_cmp_ps(a, b, _CMP_LT_OQ); }
  static Mask isAtMost(Floats a, Floats b) { return _mm256_cmp_ps(a, b, _CMP_LE_OQ); }
  static Mask both(Mask a, Mask b) { return _mm256_and_ps(a, b); }
  static unsigned bits(Mask mask) { return static_cast<unsigned>(_mm256_movemask_ps(mask)); }
  static Mask isOther(const std::uint32_t* references, std::uint32_t skipped)
  {
    const __m256i some =
      _mm256_and_si256(_mm256_load_si256(reinterpret_cast<const __m256i*>(references)),
        _mm256_set1_epi32(static_cast<int>(~TriangleBlock::kMore)));
    const __m256i isSkipped =
      _mm256_cmpeq_epi32(some, _mm256_set1_epi32(static_cast<int>(skipped)));
    return _mm256_castsi256_ps(_mm256_xor_si256(isSkipped, _mm256_set1_epi32(-1)));
  }
  static unsigned ordered(const Mask (&passed)[2], const std::uint8_t* order)
  {
    // Packing swaps the two middle groups of four lanes. The order is permuted likewise, which need
    // not wait for the planes.
    const __m256i packed =
      _mm256_packs_epi32(_mm256_castps_si256(passed[0]), _mm256_castps_si256(passed[1]));
    const __m128i bytes =
      _mm_packs_epi16(_mm256_castsi256_si128(packed), _mm256_extracti128_si256(packed, 1));
    const __m128i place = _mm_setr_epi8(0, 1, 2, 3, 8, 9, 10, 11, 4, 5, 6, 7, 12, 13, 14, 15);
    const __m128i places =
      _mm_shuffle_epi8(place, _mm_load_si128(reinterpret_cast<const __m128i*>(order)));
    return static_cast<unsigned>(_mm_movemask_epi8(_mm_shuffle_epi8(bytes, places)));
  }
};

}
}
