#ifdef __x86_64__

#include "CastCounts.h"
#include "KdTree.h"
#include "SimdTarget.h"
#include "UnitCast.h"

#include <algorithm>
#include <immintrin.h>
#include <limits>

IRRADIANCE_TARGET_BEGIN(IRRADIANCE_AVX2)

#include "WideCast.h"

namespace irradiance
{
namespace
{

/// The children of a treelet in two halves: those on the far and those on the near side of its
/// first plane. A lane is a child, from far to near; its interval begins at the last of the planes
/// that have it on their far side and ends at the first of the others.
struct Avx2Kernel
{
  __m256 origins, inverses, from, to, pad;

  void start(const UnitCast& cast)
  {
    origins = _mm256_broadcast_ps(reinterpret_cast<const __m128*>(cast.originInverse));
    inverses = _mm256_broadcast_ps(reinterpret_cast<const __m128*>(cast.inverse));
    pad = _mm256_set1_ps(cast.pad);
    resume(0, static_cast<float>(UnitCast::kFarthest));
  }

  void resume(float newFrom, float newTo)
  {
    from = _mm256_set1_ps(newFrom);
    to = _mm256_set1_ps(newTo);
  }

  struct Half
  {
    __m256 begin, end;
    __m256i child; ///< its number in the heap, 0..15
  };

  /// Where the ray passes eight planes.
  __m256 pass(__m256 planes, __m256i axes) const
  {
    return _mm256_fmsub_ps(
      planes, _mm256_permutevar_ps(inverses, axes), _mm256_permutevar_ps(origins, axes));
  }

  /// Adds the planes of the lower three levels to what the first plane left of the interval.
  Half narrow(__m256 begin, __m256 end, std::uint32_t order, __m256 upper, __m256 lower) const
  {
    const __m256i child =
      _mm256_and_si256(_mm256_srlv_epi32(_mm256_set1_epi32(static_cast<int>(order)),
                         _mm256_setr_epi32(0, 4, 8, 12, 16, 20, 24, 28)),
        _mm256_set1_epi32(15));
    const __m256i node = _mm256_or_si256(child, _mm256_set1_epi32(16));
    const __m256 level3 = _mm256_permutevar8x32_ps(lower, _mm256_srli_epi32(node, 1));
    const __m256 level2 = _mm256_permutevar8x32_ps(upper, _mm256_srli_epi32(node, 2));
    const __m256 level1 = _mm256_permutevar8x32_ps(upper, _mm256_srli_epi32(node, 3));
    const __m256 begin3 = _mm256_blend_ps(begin, level3, 0x55);
    const __m256 begin2 = _mm256_blend_ps(begin, level2, 0x33);
    const __m256 begin1 = _mm256_blend_ps(begin, level1, 0x0f);
    const __m256 end3 = _mm256_blend_ps(end, level3, 0xaa);
    const __m256 end2 = _mm256_blend_ps(end, level2, 0xcc);
    const __m256 end1 = _mm256_blend_ps(end, level1, 0xf0);
    return { _mm256_max_ps(_mm256_max_ps(begin, begin1), _mm256_max_ps(begin2, begin3)),
      _mm256_min_ps(_mm256_min_ps(end, end1), _mm256_min_ps(end2, end3)), child };
  }

  /// The children of a half that are there and that the ray passes.
  unsigned passed(const Half& half, __m256i children) const
  {
    const __m256 isPassed = _mm256_cmp_ps(half.begin, _mm256_add_ps(half.end, pad), _CMP_LE_OQ);
    const __m256i isAbsent = _mm256_cmpeq_epi32(children, _mm256_set1_epi32(-1));
    return static_cast<unsigned>(
      _mm256_movemask_ps(_mm256_andnot_ps(_mm256_castsi256_ps(isAbsent), isPassed)));
  }

  static __m256i childrenOf(const Treelet& treelet, __m256i child)
  {
    const auto* children = reinterpret_cast<const __m256i*>(treelet.children.data());
    const __m256i lower = _mm256_permutevar8x32_epi32(_mm256_load_si256(children), child);
    const __m256i upper = _mm256_permutevar8x32_epi32(_mm256_load_si256(children + 1), child);
    return _mm256_castps_si256(_mm256_blendv_ps(_mm256_castsi256_ps(lower),
      _mm256_castsi256_ps(upper), _mm256_castsi256_ps(_mm256_slli_epi32(child, 28))));
  }

  /// Puts the children that the ray passes on the stack.
  template <class Search>
  void stepInto(const Treelet& treelet, Search& search)
  {
    const std::uint64_t order = treelet.farToNear[search.cast.octant];
    const __m256i axes = _mm256_set1_epi32(static_cast<int>(treelet.axes));
    const auto* words = reinterpret_cast<const float*>(&treelet);
    const __m256 upper =
      pass(_mm256_maskload_ps(words, _mm256_setr_epi32(0, -1, -1, -1, -1, -1, -1, -1)),
        _mm256_srlv_epi32(axes, _mm256_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14)));
    const __m256 lower = pass(_mm256_load_ps(words + 8),
      _mm256_srlv_epi32(axes, _mm256_setr_epi32(16, 18, 20, 22, 24, 26, 28, 30)));
    const __m256 first = _mm256_permutevar8x32_ps(upper, _mm256_set1_epi32(1));
    const Half far =
      narrow(_mm256_max_ps(from, first), to, static_cast<std::uint32_t>(order), upper, lower);
    const Half near =
      narrow(from, _mm256_min_ps(to, first), static_cast<std::uint32_t>(order >> 32), upper, lower);
    const __m256i farChildren = childrenOf(treelet, far.child);
    const __m256i nearChildren = childrenOf(treelet, near.child);
    const unsigned found = passed(far, farChildren) | passed(near, nearChildren) << 8;
    auto& left = search.putBy(found);
    _mm256_store_ps(left.from, far.begin);
    _mm256_store_ps(left.from + 8, near.begin);
    _mm256_store_ps(left.to, far.end);
    _mm256_store_ps(left.to + 8, near.end);
    _mm256_store_si256(reinterpret_cast<__m256i*>(left.children), farChildren);
    _mm256_store_si256(reinterpret_cast<__m256i*>(left.children + 8), nearChildren);
  }
};

}

void runCastsAvx2(CastSource& source)
{
  runInTurns<Avx2Kernel>(source);
}

}

IRRADIANCE_TARGET_END

#endif
