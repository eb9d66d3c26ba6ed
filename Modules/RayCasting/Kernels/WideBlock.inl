// SPDX-License-Identifier: BSD-3-Clause
// No include guard: a part of WideQuery.inl.

namespace irradiance
{
namespace
{

/// What floats can say about the triangles of a block.
struct BlockResult
{
  unsigned possible;           ///< one bit each: may be the closest hit
  unsigned certain;            ///< one bit each: is hit for certain
  __m256 size, distance, blur; ///< a hit is at distance / size; each may be off by blur
};

/// Rejects only what the test in double cannot accept. Unused places hold NaN and are rejected.
inline BlockResult testBlock(const TriangleBlock& block, const TreeQuery& query)
{
  const __m256 dx = _mm256_set1_ps(query.direction[0]), dy = _mm256_set1_ps(query.direction[1]),
               dz = _mm256_set1_ps(query.direction[2]);
  const __m256 cx = _mm256_sub_ps(_mm256_load_ps(block.corner[0]), _mm256_set1_ps(query.origin[0]));
  const __m256 cy = _mm256_sub_ps(_mm256_load_ps(block.corner[1]), _mm256_set1_ps(query.origin[1]));
  const __m256 cz = _mm256_sub_ps(_mm256_load_ps(block.corner[2]), _mm256_set1_ps(query.origin[2]));
  const __m256 ax = _mm256_load_ps(block.edge1[0]), ay = _mm256_load_ps(block.edge1[1]),
               az = _mm256_load_ps(block.edge1[2]);
  const __m256 bx = _mm256_load_ps(block.edge2[0]), by = _mm256_load_ps(block.edge2[1]),
               bz = _mm256_load_ps(block.edge2[2]);
  // normal = edge1 x edge2, moment = (corner - origin) x direction
  const __m256 nx = _mm256_fmsub_ps(ay, bz, _mm256_mul_ps(az, by));
  const __m256 ny = _mm256_fmsub_ps(az, bx, _mm256_mul_ps(ax, bz));
  const __m256 nz = _mm256_fmsub_ps(ax, by, _mm256_mul_ps(ay, bx));
  const __m256 mx = _mm256_fmsub_ps(cy, dz, _mm256_mul_ps(cz, dy));
  const __m256 my = _mm256_fmsub_ps(cz, dx, _mm256_mul_ps(cx, dz));
  const __m256 mz = _mm256_fmsub_ps(cx, dy, _mm256_mul_ps(cy, dx));
  const __m256 determinant =
    _mm256_fmadd_ps(nx, dx, _mm256_fmadd_ps(ny, dy, _mm256_mul_ps(nz, dz)));
  const __m256 minusZero = _mm256_set1_ps(-0.0F);
  const __m256 sign = _mm256_and_ps(determinant, minusZero);
  const __m256 size = _mm256_xor_ps(determinant, sign);
  const __m256 u =
    _mm256_xor_ps(sign, _mm256_fmadd_ps(mx, bx, _mm256_fmadd_ps(my, by, _mm256_mul_ps(mz, bz))));
  const __m256 v =
    _mm256_xor_ps(sign, _mm256_fnmsub_ps(mx, ax, _mm256_fmadd_ps(my, ay, _mm256_mul_ps(mz, az))));
  const __m256 distance =
    _mm256_xor_ps(sign, _mm256_fmadd_ps(nx, cx, _mm256_fmadd_ps(ny, cy, _mm256_mul_ps(nz, cz))));

  const auto absolute = [minusZero](__m256 x) { return _mm256_andnot_ps(minusZero, x); };
  const __m256 length =
    _mm256_add_ps(_mm256_add_ps(absolute(ax), _mm256_add_ps(absolute(ay), absolute(az))),
      _mm256_add_ps(absolute(bx), _mm256_add_ps(absolute(by), absolute(bz))));
  const __m256 least = _mm256_set1_ps(query.leastBlur);
  const __m256 edgeBlur = _mm256_fmadd_ps(_mm256_set1_ps(query.edgeBlur), length, least);
  const __m256 blur =
    _mm256_mul_ps(length, _mm256_fmadd_ps(_mm256_set1_ps(TreeQuery::kSizeBlur), length, least));
  const __m256 inside =
    _mm256_min_ps(_mm256_min_ps(u, v), _mm256_sub_ps(size, _mm256_add_ps(u, v)));
  const __m256 far = _mm256_fmadd_ps(size, _mm256_set1_ps(query.limit), blur);
  const __m256 near = _mm256_fmadd_ps(size, _mm256_set1_ps(query.slack), blur);
  const __m256 zero = _mm256_setzero_ps();
  const __m256i references =
    _mm256_and_si256(_mm256_load_si256(reinterpret_cast<const __m256i*>(block.references)),
      _mm256_set1_epi32(static_cast<int>(~TriangleBlock::kMore)));
  const __m256 isSkipped = _mm256_castsi256_ps(
    _mm256_cmpeq_epi32(references, _mm256_set1_epi32(static_cast<int>(query.skipped))));
  const __m256 isPossible = _mm256_andnot_ps(isSkipped,
    _mm256_and_ps(_mm256_cmp_ps(_mm256_add_ps(inside, edgeBlur), zero, _CMP_GE_OQ),
      _mm256_and_ps(_mm256_cmp_ps(distance, far, _CMP_LE_OQ),
        _mm256_cmp_ps(_mm256_add_ps(distance, near), zero, _CMP_GE_OQ))));
  const __m256 isCertain = _mm256_and_ps(
    _mm256_cmp_ps(inside, edgeBlur, _CMP_GT_OQ), _mm256_cmp_ps(distance, near, _CMP_GT_OQ));
  return { static_cast<unsigned>(_mm256_movemask_ps(isPossible)),
    static_cast<unsigned>(_mm256_movemask_ps(isCertain)), size, distance, blur };
}

/// The triangles found so far that may be the closest hit.
struct Candidates
{
  static constexpr unsigned kMost = 32;

  unsigned count;
  std::uint32_t references[kMost];
  float distances[kMost]; ///< lower bounds of distance * size
  float sizes[kMost];     ///< upper bounds

  /// Drops what lies behind the limit.
  void sift(float limit)
  {
    unsigned kept = 0;
    for (unsigned i = 0; i < count; ++i)
    {
      references[kept] = references[i];
      distances[kept] = distances[i];
      sizes[kept] = sizes[i];
      kept += distances[i] > limit * sizes[i] ? 0 : 1; // NaN stays
    }
    count = kept;
  }
};

}
}
