// No include guard: included once by each kernel, between IRRADIANCE_TARGET_BEGIN and _END, after
// <immintrin.h> and "UnitCast.h". Only for kernels that have AVX2 and FMA.

namespace irradiance
{
namespace
{

/// The triangles of a block that the ray may hit, one bit for each. Rejects by floats only what the
/// test in double cannot accept; unused places hold NaN and are rejected.
inline unsigned trianglesToTest(const TriangleBlock& block, const UnitCast& cast)
{
  const __m256 dx = _mm256_set1_ps(cast.direction[0]), dy = _mm256_set1_ps(cast.direction[1]),
               dz = _mm256_set1_ps(cast.direction[2]);
  const __m256 cx = _mm256_sub_ps(_mm256_load_ps(block.corner[0]), _mm256_set1_ps(cast.origin[0]));
  const __m256 cy = _mm256_sub_ps(_mm256_load_ps(block.corner[1]), _mm256_set1_ps(cast.origin[1]));
  const __m256 cz = _mm256_sub_ps(_mm256_load_ps(block.corner[2]), _mm256_set1_ps(cast.origin[2]));
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
  const __m256 u = _mm256_xor_ps(
    sign, _mm256_fmadd_ps(mx, bx, _mm256_fmadd_ps(my, by, _mm256_mul_ps(mz, bz))));
  const __m256 v = _mm256_xor_ps(
    sign, _mm256_fnmsub_ps(mx, ax, _mm256_fmadd_ps(my, ay, _mm256_mul_ps(mz, az))));
  const __m256 distance = _mm256_xor_ps(
    sign, _mm256_fmadd_ps(nx, cx, _mm256_fmadd_ps(ny, cy, _mm256_mul_ps(nz, cz))));

  const auto absolute = [minusZero](__m256 x) { return _mm256_andnot_ps(minusZero, x); };
  const __m256 length = _mm256_add_ps(
    _mm256_add_ps(absolute(ax), _mm256_add_ps(absolute(ay), absolute(az))),
    _mm256_add_ps(absolute(bx), _mm256_add_ps(absolute(by), absolute(bz))));
  const __m256 blur = _mm256_fmadd_ps(
    _mm256_set1_ps(cast.edgeBlur), length, _mm256_set1_ps(cast.leastBlur));
  const __m256 least = _mm256_min_ps(_mm256_min_ps(u, v), _mm256_sub_ps(size, _mm256_add_ps(u, v)));
  const __m256 far =
    _mm256_fmadd_ps(size, _mm256_set1_ps(cast.limit), _mm256_mul_ps(blur, length));
  const __m256 near =
    _mm256_fmadd_ps(size, _mm256_set1_ps(cast.slack), _mm256_mul_ps(blur, length));
  const __m256 isInside = _mm256_cmp_ps(_mm256_add_ps(least, blur), _mm256_setzero_ps(), _CMP_GE_OQ);
  const __m256 isBefore = _mm256_cmp_ps(distance, far, _CMP_LE_OQ);
  const __m256 isAhead = _mm256_cmp_ps(_mm256_add_ps(distance, near), _mm256_setzero_ps(), _CMP_GE_OQ);
  return static_cast<unsigned>(
    _mm256_movemask_ps(_mm256_and_ps(isInside, _mm256_and_ps(isBefore, isAhead))));
}

/// A search on its way. `Interval` is a kernel's form of the piece of the ray inside the child.
template <class Kernel>
struct WideSearch
{
  /// 15 treelets deep, of each at most 15 children put by; and room for a whole store behind.
  static constexpr unsigned kStack = 15 * (KdTree::kMaxDepth / 4 + 1) + 16;

  UnitCast cast;
  Kernel kernel;
  std::uint32_t child;
  unsigned depth;
  alignas(64) std::uint32_t children[kStack];
  alignas(64) float froms[kStack];
  alignas(64) float tos[kStack];

  /// Takes the next search that floats can follow; those they cannot are done on the way.
  bool start(CastSource& source)
  {
    while (source.next(cast))
    {
      if (cast.isForFloats)
      {
        child = cast.tree->root();
        depth = 0;
        kernel.start(cast);
        return true;
      }
      runCastPlain(source, cast);
    }
    return false;
  }

  /// One treelet or leaf; false at the end.
  bool step(CastSource& source)
  {
    if ((child & Treelet::kLeaf) == 0)
    {
      if (kernel.stepInto(cast.tree->treelets()[child], *this))
      {
        return true;
      }
    }
    else if (child != Treelet::kEmpty)
    {
      testLeaf(source, cast.tree->blocks() + (child & ~Treelet::kLeaf));
    }
    return takeFromStack();
  }

private:
  void testLeaf(CastSource& source, const TriangleBlock* block)
  {
    for (bool goesOn = true; goesOn; ++block)
    {
      goesOn = !block->isLast();
      for (unsigned found = trianglesToTest(*block, cast); found != 0; found &= found - 1)
      {
        source.test(cast, block->reference(static_cast<unsigned>(__builtin_ctz(found))));
      }
    }
  }

  bool takeFromStack()
  {
    // What lies deeper in the stack is farther away.
    if (depth == 0 || froms[--depth] > cast.limit)
    {
      return false;
    }
    child = children[depth];
    kernel.resume(froms[depth], tos[depth]);
    return true;
  }
};

/// Two searches in turns: while one waits for memory, or for a branch, the other computes.
template <class Kernel>
void runTwoByTwo(CastSource& source)
{
  static thread_local WideSearch<Kernel> first, second;
  bool hasFirst = first.start(source), hasSecond = hasFirst && second.start(source);
  while (hasFirst && hasSecond)
  {
    if (__builtin_expect(!first.step(source), 0))
    {
      hasFirst = first.start(source);
    }
    if (__builtin_expect(!second.step(source), 0))
    {
      hasSecond = second.start(source);
    }
  }
  WideSearch<Kernel>& last = hasFirst ? first : second;
  for (bool goesOn = hasFirst || hasSecond; goesOn;)
  {
    goesOn = last.step(source) || last.start(source);
  }
}

}
}
