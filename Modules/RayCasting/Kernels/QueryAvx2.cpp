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

IRRADIANCE_TARGET_BEGIN(IRRADIANCE_AVX2)

#include "Kernels/WideQuery.inl"

namespace irradiance
{
namespace
{

/// Tests the 16 boxes of a treelet in two halves.
struct Avx2Kernel
{
  static __m256 pass(const float* planes, const TreeQuery& query, int axis)
  {
    return _mm256_fmsub_ps(_mm256_load_ps(planes), _mm256_broadcast_ss(query.inverse + axis),
      _mm256_broadcast_ss(query.originInverse + axis));
  }

  /// Writes to `from` where the ray enters eight boxes; all bits are set of those that it passes.
  static __m256i enterHalf(
    const float* planes, const BoxFaces& faces, const TreeQuery& query, float* from)
  {
    const __m256 begin = _mm256_max_ps(
      _mm256_max_ps(pass(planes + faces.near[0], query, 0), pass(planes + faces.near[1], query, 1)),
      _mm256_max_ps(pass(planes + faces.near[2], query, 2), _mm256_setzero_ps()));
    const __m256 end = _mm256_min_ps(
      _mm256_min_ps(pass(planes + faces.far[0], query, 0), pass(planes + faces.far[1], query, 1)),
      _mm256_min_ps(pass(planes + faces.far[2], query, 2), _mm256_broadcast_ss(&query.limit)));
    _mm256_store_ps(from, begin);
    return _mm256_castps_si256(
      _mm256_cmp_ps(begin, _mm256_add_ps(end, _mm256_broadcast_ss(&query.pad)), _CMP_LE_OQ));
  }

  /// Writes to `from` where the ray enters the boxes; returns the ones it passes, one bit each,
  /// from far to near.
  static unsigned enter(
    const Treelet& treelet, const BoxFaces& faces, const TreeQuery& query, float* from)
  {
    const float* planes = &treelet.bounds[0][0][0];
    const __m256i first = enterHalf(planes, faces, query, from);
    const __m256i second = enterHalf(planes + 8, faces, query, from + 8);
    // Packing swaps the two middle groups of four lanes; so does what follows to the order, which
    // does not wait for the planes.
    const __m256i both = _mm256_packs_epi32(first, second);
    const __m128i passed =
      _mm_packs_epi16(_mm256_castsi256_si128(both), _mm256_extracti128_si256(both, 1));
    const __m128i packed = _mm_setr_epi8(0, 1, 2, 3, 8, 9, 10, 11, 4, 5, 6, 7, 12, 13, 14, 15);
    const __m128i order =
      _mm_load_si128(reinterpret_cast<const __m128i*>(treelet.farToNear[query.octant]));
    return static_cast<unsigned>(
      _mm_movemask_epi8(_mm_shuffle_epi8(passed, _mm_shuffle_epi8(packed, order))));
  }
};

}

void runQueriesAvx2(QuerySource& source)
{
  runInTurns<Avx2Kernel>(source);
}

void intersectAllAvx2(IntersectionLanes& lanes)
{
  lanes.intersect();
}

}

IRRADIANCE_TARGET_END

#endif
