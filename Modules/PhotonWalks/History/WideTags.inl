// SPDX-License-Identifier: BSD-3-Clause
// No include guard: the wide kernels of the scan include this once, between the marks of their
// target.

namespace irradiance
{
namespace
{

/// Looks at the tags of 16 segments.
struct WideTags
{
  static __m128i load(const std::uint8_t* tags)
  {
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(tags));
  }
  static unsigned bitsOf(__m128i lanes) { return static_cast<unsigned>(_mm_movemask_epi8(lanes)); }

  /// Those that hold a segment.
  static unsigned stored(const std::uint8_t* tags)
  {
    constexpr unsigned kAll = 0xffff;
    return kAll ^
      bitsOf(_mm_cmpeq_epi8(load(tags), _mm_set1_epi8(static_cast<char>(BounceTag::kFree))));
  }
  /// TagSet::has.
  static unsigned tagged(const std::uint8_t* tags, const TagSet& set)
  {
    const __m128i all = load(tags);
    const __m128i row = _mm_shuffle_epi8(load(set.rows), _mm_and_si128(all, _mm_set1_epi8(0xf)));
    const __m128i upper = _mm_and_si128(_mm_srli_epi16(all, 4), _mm_set1_epi8(7));
    const __m128i bits = _mm_setr_epi8(1, 2, 4, 8, 16, 32, 64, -128, 0, 0, 0, 0, 0, 0, 0, 0);
    const __m128i kept = _mm_and_si128(row, _mm_shuffle_epi8(bits, upper));
    const unsigned without = bitsOf(_mm_cmpeq_epi8(kept, _mm_setzero_si128()));
    const unsigned open = bitsOf(_mm_and_si128(all, _mm_set1_epi8(static_cast<char>(set.open))));
    constexpr unsigned kAll = 0xffff;
    return (kAll ^ without) | open;
  }
};

}
}
