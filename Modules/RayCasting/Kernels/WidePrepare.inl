// SPDX-License-Identifier: BSD-3-Clause
// No include guard: a part of WideQuery.inl.

namespace irradiance
{
namespace
{

inline __m256d absolute(__m256d x)
{
  return _mm256_andnot_pd(_mm256_set1_pd(-0.0), x);
}

inline double largestOf(__m256d x)
{
  const __m128d both = _mm_max_pd(_mm256_castpd256_pd128(x), _mm256_extractf128_pd(x, 1));
  return _mm_cvtsd_f64(_mm_max_sd(both, _mm_unpackhi_pd(both, both)));
}

inline double smallestOf(__m256d x)
{
  const __m128d both = _mm_min_pd(_mm256_castpd256_pd128(x), _mm256_extractf128_pd(x, 1));
  return _mm_cvtsd_f64(_mm_min_sd(both, _mm_unpackhi_pd(both, both)));
}

/// Three coordinates, the first of them twice. Reads eight bytes beyond the vector.
inline __m256d loadVector(const Vector3& vector)
{
  return _mm256_permute4x64_pd(_mm256_loadu_pd(vector.data()), 0x24);
}

/// Does what TreeQuery::prepare() does, for searches in floats; clears isForFloats where floats
/// cannot follow. False if the ray misses the tree's box or enters it too late.
inline bool prepareWide(const QueryRequest& request, TreeQuery& query)
{
  const TriangleTree& tree = *request.tree;
  query.tree = &tree;
  query.skipped = request.skipped;
  query.job = request.job;
  query.isShared = request.isShared;
  const __m256d worldDirection = loadVector(request.direction);
  const double largest = largestOf(absolute(worldDirection));
  const __m256d direction = _mm256_div_pd(worldDirection, _mm256_set1_pd(largest));
  const __m256d inverse = _mm256_div_pd(_mm256_set1_pd(largest), worldDirection);
  const __m256d origin =
    _mm256_mul_pd(_mm256_sub_pd(loadVector(request.origin), loadVector(tree.frame().center)),
      _mm256_set1_pd(tree.frame().scale));
  const double flattest = largestOf(absolute(inverse));
  query.isForFloats = flattest <= 1 / TreeQuery::kSmallestComponent &&
    largestOf(absolute(origin)) <= TreeQuery::kLargestOrigin;
  const __m256d lower =
    _mm256_mul_pd(_mm256_sub_pd(loadVector(tree.bounds().lower), origin), inverse);
  const __m256d upper =
    _mm256_mul_pd(_mm256_sub_pd(loadVector(tree.bounds().upper), origin), inverse);
  query.rate = largest * tree.frame().scale;
  const double from = std::max(0.0, request.from * query.rate - tree.slack());
  query.entry = std::max(from, largestOf(_mm256_min_pd(lower, upper)));
  const double exit = smallestOf(_mm256_max_pd(lower, upper));
  const double padding = TreeQuery::kBlur * flattest;
  if (query.isForFloats && query.entry > exit + padding)
  {
    return false;
  }
  const __m128 begin =
    _mm256_cvtpd_ps(_mm256_fmadd_pd(direction, _mm256_set1_pd(query.entry), origin));
  const __m128 inverses = _mm256_cvtpd_ps(inverse);
  _mm_store_ps(query.origin, begin);
  _mm_store_ps(query.direction, _mm256_cvtpd_ps(direction));
  _mm_store_ps(query.inverse, inverses);
  _mm_store_ps(query.originInverse, _mm_mul_ps(begin, inverses));
  query.octant = static_cast<unsigned>(_mm256_movemask_pd(worldDirection)) & 7u;
  query.setMargins(padding);
  query.setBound(request.bound);
  return !query.isForFloats || query.limit >= 0;
}

}
}
