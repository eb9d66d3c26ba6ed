// No include guard: a part of WideCast.h.

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

/// Three coordinates, the first of them twice. Reads eight bytes more, of what follows them.
inline __m256d loadVector(const Vector3& vector)
{
  return _mm256_permute4x64_pd(_mm256_loadu_pd(vector.data()), 0x24);
}

/// What UnitCast::prepare() does, for searches in floats; those that floats cannot follow are marked.
/// False if the ray misses the tree's box.
inline bool prepareWide(const CastRequest& request, UnitCast& cast)
{
  const TriangleTree& tree = *request.tree;
  cast.tree = &tree;
  cast.skipped = request.skipped;
  cast.job = request.job;
  cast.isShared = request.isShared;
  const __m256d worldDirection = loadVector(request.direction);
  const double largest = largestOf(absolute(worldDirection));
  const __m256d direction = _mm256_div_pd(worldDirection, _mm256_set1_pd(largest));
  const __m256d inverse = _mm256_div_pd(_mm256_set1_pd(largest), worldDirection);
  const __m256d origin =
    _mm256_mul_pd(_mm256_sub_pd(loadVector(request.origin), loadVector(tree.frame().center)),
      _mm256_set1_pd(tree.frame().scale));
  const double flattest = largestOf(absolute(inverse));
  cast.isForFloats = flattest <= 1 / UnitCast::kSmallestComponent &&
    largestOf(absolute(origin)) <= UnitCast::kLargestOrigin;
  const __m256d lower =
    _mm256_mul_pd(_mm256_sub_pd(loadVector(tree.bounds().lower), origin), inverse);
  const __m256d upper =
    _mm256_mul_pd(_mm256_sub_pd(loadVector(tree.bounds().upper), origin), inverse);
  cast.rate = largest * tree.frame().scale;
  const double from = std::max(0.0, request.from * cast.rate - tree.slack());
  cast.entry = std::max(from, largestOf(_mm256_min_pd(lower, upper)));
  const double exit = smallestOf(_mm256_max_pd(lower, upper));
  const double padding = UnitCast::kBlur * flattest;
  if (cast.isForFloats && cast.entry > exit + padding)
  {
    return false;
  }
  const __m128 begin =
    _mm256_cvtpd_ps(_mm256_fmadd_pd(direction, _mm256_set1_pd(cast.entry), origin));
  const __m128 inverses = _mm256_cvtpd_ps(inverse);
  _mm_store_ps(cast.origin, begin);
  _mm_store_ps(cast.direction, _mm256_cvtpd_ps(direction));
  _mm_store_ps(cast.inverse, inverses);
  _mm_store_ps(cast.originInverse, _mm_mul_ps(begin, inverses));
  cast.octant = static_cast<unsigned>(_mm256_movemask_pd(worldDirection)) & 7u;
  cast.setMargins(padding);
  cast.setBound(request.bound);
  return !cast.isForFloats || cast.limit >= 0;
}

}
}
