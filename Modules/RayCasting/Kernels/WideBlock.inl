// SPDX-License-Identifier: BSD-3-Clause
// No include guard: a part of WideQuery.inl.

namespace irradiance
{
namespace
{

/// Vectors, one to a lane.
template <class Lanes>
struct FloatVectors
{
  using Floats = typename Lanes::Floats;

  Floats x, y, z;

  /// The same vector in all lanes.
  explicit FloatVectors(const float* vector)
    : FloatVectors(Lanes::all(vector[0]), Lanes::all(vector[1]), Lanes::all(vector[2]))
  {
  }
  FloatVectors(const float (&vectors)[3][TriangleBlock::kSize], unsigned first)
    : FloatVectors(Lanes::load(vectors[0] + first), Lanes::load(vectors[1] + first),
        Lanes::load(vectors[2] + first))
  {
  }
  FloatVectors(Floats a, Floats b, Floats c)
    : x(a)
    , y(b)
    , z(c)
  {
  }

  FloatVectors operator-(const FloatVectors& b) const { return { x - b.x, y - b.y, z - b.z }; }
  FloatVectors cross(const FloatVectors& b) const
  {
    return { Lanes::mulSubtract(y, b.z, z * b.y), Lanes::mulSubtract(z, b.x, x * b.z),
      Lanes::mulSubtract(x, b.y, y * b.x) };
  }
  Floats dot(const FloatVectors& b) const
  {
    return Lanes::mulAdd(x, b.x, Lanes::mulAdd(y, b.y, z * b.z));
  }
  Floats sum() const { return Lanes::absolute(x) + (Lanes::absolute(y) + Lanes::absolute(z)); }
};

/// What floats can say about the triangles of a block, or of a part of it.
template <class Lanes>
struct BlockResult
{
  unsigned possible; ///< one bit each: may be the closest hit
  unsigned certain;  ///< one bit each: is hit for certain
  /// A hit is at distance / size; each may be off by blur.
  typename Lanes::Floats size, distance, blur;
};

/// Tests the triangles from `first` on. Rejects only what the test in double cannot accept. Unused
/// places hold NaN and are rejected.
template <class Lanes>
inline BlockResult<Lanes> testBlock(
  const TriangleBlock& block, unsigned first, const TreeQuery& query)
{
  using Floats = typename Lanes::Floats;
  using Vectors = FloatVectors<Lanes>;
  const Vectors direction(query.direction);
  const Vectors toCorner = Vectors(block.corner, first) - Vectors(query.origin);
  const Vectors edge1(block.edge1, first), edge2(block.edge2, first);
  const Vectors normal = edge1.cross(edge2), moment = toCorner.cross(direction);
  const Floats determinant = normal.dot(direction);
  const Floats sign = Lanes::signOf(determinant), size = Lanes::flip(determinant, sign);
  const Floats u = Lanes::flip(moment.dot(edge2), sign);
  const Floats v = Lanes::flip(-moment.dot(edge1), sign);
  const Floats distance = Lanes::flip(normal.dot(toCorner), sign);

  const Floats length = edge1.sum() + edge2.sum(), least = Lanes::all(query.leastBlur);
  const Floats edgeBlur = Lanes::mulAdd(Lanes::all(query.edgeBlur), length, least);
  const Floats blur = length * Lanes::mulAdd(Lanes::all(TreeQuery::kSizeBlur), length, least);
  // Of a NaN and a number, least() takes the second.
  const Floats inside = Lanes::least(Lanes::least(u, v), size - (u + v));
  const Floats far = Lanes::mulAdd(size, Lanes::all(query.limit), blur);
  const Floats near = Lanes::mulAdd(size, Lanes::all(query.slack), blur);
  const auto isPossible = Lanes::both(Lanes::isOther(block.references + first, query.skipped),
    Lanes::both(Lanes::isAtMost(-edgeBlur, inside),
      Lanes::both(Lanes::isAtMost(distance, far), Lanes::isAtMost(-near, distance))));
  const auto isCertain =
    Lanes::both(Lanes::isLess(edgeBlur, inside), Lanes::isLess(near, distance));
  return { Lanes::bits(isPossible), Lanes::bits(isCertain), size, distance, blur };
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
