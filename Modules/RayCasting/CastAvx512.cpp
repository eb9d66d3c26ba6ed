#ifdef __x86_64__

#include "CastCounts.h"
#include "KdTree.h"
#include "SimdTarget.h"
#include "UnitCast.h"

#include <algorithm>
#include <immintrin.h>
#include <limits>

IRRADIANCE_TARGET_BEGIN(IRRADIANCE_AVX512)

#include "WideCast.h"

namespace irradiance
{
namespace
{

/// All 16 children of a treelet at once. A lane is a child, from far to near; its interval begins at
/// the last of the planes that have it on their far side and ends at the first of the others.
struct Avx512Kernel
{
  __m512 origins, inverses, from, to, pad;

  void start(const UnitCast& cast)
  {
    origins = _mm512_broadcast_f32x4(_mm_load_ps(cast.originInverse));
    inverses = _mm512_broadcast_f32x4(_mm_load_ps(cast.inverse));
    pad = _mm512_set1_ps(cast.pad);
    resume(0, static_cast<float>(UnitCast::kFarthest));
  }

  void resume(float newFrom, float newTo)
  {
    from = _mm512_set1_ps(newFrom);
    to = _mm512_set1_ps(newTo);
  }

  /// Puts the children that the ray passes on the stack.
  template <class Search>
  void stepInto(const Treelet& treelet, Search& search)
  {
    const __m512i twos =
      _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
    const __m512i fours =
      _mm512_setr_epi32(0, 4, 8, 12, 16, 20, 24, 28, 0, 4, 8, 12, 16, 20, 24, 28);
    const __m512i halves = _mm512_setr_epi32(0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1);
    const std::uint64_t order = treelet.farToNear[search.cast.octant];
    // Where the ray passes the planes; lane i is plane i.
    const __m512i axes = _mm512_srlv_epi32(_mm512_set1_epi32(static_cast<int>(treelet.axes)), twos);
    const __m512 planes = _mm512_fmsub_ps(_mm512_maskz_loadu_ps(0xfffe, &treelet),
      _mm512_permutevar_ps(inverses, axes), _mm512_permutevar_ps(origins, axes));
    // The child's number in the heap, 16..31; its ancestors are the halves of it.
    const __m512i packed = _mm512_permutexvar_epi32(
      halves, _mm512_castsi128_si512(_mm_cvtsi64_si128(static_cast<long long>(order))));
    const __m512i child = _mm512_ternarylogic_epi32(
      _mm512_srlv_epi32(packed, fours), _mm512_set1_epi32(15), _mm512_set1_epi32(16), 0xEA);
    const __m512 level3 = _mm512_permutexvar_ps(_mm512_srli_epi32(child, 1), planes);
    const __m512 level2 = _mm512_permutexvar_ps(_mm512_srli_epi32(child, 2), planes);
    const __m512 level1 = _mm512_permutexvar_ps(_mm512_srli_epi32(child, 3), planes);
    const __m512 level0 = _mm512_permutexvar_ps(_mm512_srli_epi32(child, 4), planes);
    __m512 begin = _mm512_mask_max_ps(from, 0x5555, from, level3);
    __m512 begin2 = _mm512_mask_max_ps(from, 0x3333, from, level2);
    __m512 end = _mm512_mask_min_ps(to, 0xaaaa, to, level3);
    __m512 end2 = _mm512_mask_min_ps(to, 0xcccc, to, level2);
    begin = _mm512_mask_max_ps(begin, 0x0f0f, begin, level1);
    begin2 = _mm512_mask_max_ps(begin2, 0x00ff, begin2, level0);
    end = _mm512_mask_min_ps(end, 0xf0f0, end, level1);
    end2 = _mm512_mask_min_ps(end2, 0xff00, end2, level0);
    begin = _mm512_max_ps(begin, begin2);
    end = _mm512_min_ps(end, end2);
    const __m512i children =
      _mm512_permutexvar_epi32(child, _mm512_load_si512(treelet.children.data()));
    const __mmask16 isThere = _mm512_cmpneq_epi32_mask(children, _mm512_set1_epi32(-1));
    const unsigned passed =
      _mm512_mask_cmp_ps_mask(isThere, begin, _mm512_add_ps(end, pad), _CMP_LE_OQ);
    auto& left = search.putBy(passed);
    _mm512_store_ps(left.from, begin);
    _mm512_store_ps(left.to, end);
    _mm512_store_si512(left.children, children);
  }
};

}

void runCastsAvx512(CastSource& source)
{
  runInTurns<Avx512Kernel>(source);
}

}

IRRADIANCE_TARGET_END

#endif
