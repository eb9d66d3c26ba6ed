// SPDX-License-Identifier: BSD-3-Clause
#ifdef __x86_64__

#include "Kernels/IntersectionLanes.h"
#include "Kernels/QueryCounts.h"
#include "Kernels/TreeQuery.h"
#include "Simd/SimdTarget.h"
#include "Trees/KdTree.h"

#include <algorithm>
#include <immintrin.h>
#include <limits>

IRRADIANCE_TARGET_BEGIN(IRRADIANCE_AVX512)

#include "Kernels/WideQuery.inl"

namespace irradiance
{
namespace
{

/// Tests all 16 boxes of a treelet at once.
struct Avx512Kernel
{
  static __m512 pass(const float* planes, const TreeQuery& query, int axis)
  {
    return _mm512_fmsub_ps(_mm512_load_ps(planes), _mm512_set1_ps(query.inverse[axis]),
      _mm512_set1_ps(query.originInverse[axis]));
  }

  /// Writes to `from` where the ray enters the boxes; returns the ones it passes, one bit each,
  /// from far to near.
  static unsigned enter(
    const Treelet& treelet, const BoxFaces& faces, const TreeQuery& query, float* from)
  {
    const float* planes = &treelet.bounds[0][0][0];
    const __m512 begin = _mm512_max_ps(
      _mm512_max_ps(pass(planes + faces.near[0], query, 0), pass(planes + faces.near[1], query, 1)),
      _mm512_max_ps(pass(planes + faces.near[2], query, 2), _mm512_setzero_ps()));
    const __m512 end = _mm512_min_ps(
      _mm512_min_ps(pass(planes + faces.far[0], query, 0), pass(planes + faces.far[1], query, 1)),
      _mm512_min_ps(pass(planes + faces.far[2], query, 2), _mm512_set1_ps(query.limit)));
    _mm512_store_ps(from, begin);
    const __mmask16 passed =
      _mm512_cmp_ps_mask(begin, _mm512_add_ps(end, _mm512_set1_ps(query.pad)), _CMP_LE_OQ);
    const __m128i order =
      _mm_load_si128(reinterpret_cast<const __m128i*>(treelet.farToNear[query.octant]));
    return static_cast<unsigned>(_mm_movemask_epi8(_mm_shuffle_epi8(_mm_movm_epi8(passed), order)));
  }
};

}

void runQueriesAvx512(QuerySource& source)
{
  runInTurns<Avx512Kernel>(source);
}

void intersectAllAvx512(IntersectionLanes& lanes)
{
  lanes.intersect();
}

}

IRRADIANCE_TARGET_END

#endif
