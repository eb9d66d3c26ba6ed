// No include guard: included once by each kernel, between IRRADIANCE_TARGET_BEGIN and _END, after
// <immintrin.h> and "UnitCast.h". Only for kernels that have AVX2 and FMA.

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
  const __m128 inverses = _mm_blend_ps(_mm256_cvtpd_ps(inverse), _mm_set1_ps(1), 8);
  _mm_store_ps(cast.origin, begin);
  _mm_store_ps(cast.direction, _mm256_cvtpd_ps(direction));
  _mm_store_ps(cast.inverse, inverses);
  _mm_store_ps(cast.originInverse, _mm_blend_ps(_mm_mul_ps(begin, inverses), _mm_setzero_ps(), 8));
  cast.octant = static_cast<unsigned>(_mm256_movemask_pd(worldDirection)) & 7u;
  cast.pad = static_cast<float>(2 * padding);
  cast.slack = static_cast<float>(tree.slack() + UnitCast::kBlur);
  cast.margin = cast.slack + cast.pad;
  cast.edgeBlur = static_cast<float>(UnitCast::kEdgeBlur + 4 * tree.blur());
  cast.leastBlur = static_cast<float>(UnitCast::kLeastBlur + 32 * tree.blur());
  cast.limit = static_cast<float>(
    std::min(request.bound * cast.rate - cast.entry + cast.margin, UnitCast::kFarthest));
  return !cast.isForFloats || cast.limit >= 0;
}

/// What floats can say of the triangles of a block, one bit for each.
struct BlockAnswer
{
  unsigned possible;           ///< may be the closest hit
  unsigned certain;            ///< are hit for sure
  __m256 size, distance, blur; ///< a hit is at distance / size, both up to the blur
};

/// Leaves out only what the test in double cannot accept; unused places hold NaN and drop out.
inline BlockAnswer askBlock(const TriangleBlock& block, const UnitCast& cast)
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
  const __m256 least = _mm256_set1_ps(cast.leastBlur);
  const __m256 edgeBlur = _mm256_fmadd_ps(_mm256_set1_ps(cast.edgeBlur), length, least);
  const __m256 blur =
    _mm256_mul_ps(length, _mm256_fmadd_ps(_mm256_set1_ps(UnitCast::kSizeBlur), length, least));
  const __m256 inside =
    _mm256_min_ps(_mm256_min_ps(u, v), _mm256_sub_ps(size, _mm256_add_ps(u, v)));
  const __m256 far = _mm256_fmadd_ps(size, _mm256_set1_ps(cast.limit), blur);
  const __m256 near = _mm256_fmadd_ps(size, _mm256_set1_ps(cast.slack), blur);
  const __m256 zero = _mm256_setzero_ps();
  const __m256i references =
    _mm256_and_si256(_mm256_load_si256(reinterpret_cast<const __m256i*>(block.references)),
      _mm256_set1_epi32(static_cast<int>(~TriangleBlock::kMore)));
  const __m256 isSkipped = _mm256_castsi256_ps(
    _mm256_cmpeq_epi32(references, _mm256_set1_epi32(static_cast<int>(cast.skipped))));
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
  float distances[kMost]; ///< at least, in units of the size
  float sizes[kMost];     ///< at most

  /// Drops what lies behind the limit.
  void sift(float limit)
  {
    unsigned kept = 0;
    for (unsigned i = 0; i < count; ++i)
    {
      references[kept] = references[i];
      distances[kept] = distances[i];
      sizes[kept] = sizes[i];
      kept += distances[i] > limit * sizes[i] ? 0 : 1; // what is not a number stays
    }
    count = kept;
  }
};

/// Searches prepared in advance, many at a time: that leaves the processor free to do several at
/// once.
class CastQueue
{
public:
  explicit CastQueue(CastSource& source)
    : source_(source)
  {
  }

  /// The next search that floats can follow; false if there is none. Those they cannot are done on
  /// the way.
  bool next(UnitCast& cast)
  {
    for (;;)
    {
      if (next_ == count_)
      {
        next_ = 0;
        count_ = source_.next(requests_, kMost);
        if (count_ == 0)
        {
          return false;
        }
      }
      const CastRequest& request = requests_[next_++];
      if (request.tree->isEmpty() || !prepareWide(request, cast))
      {
        continue;
      }
      if (cast.isForFloats)
      {
        return true;
      }
      if (cast.prepare(request))
      {
        runCastPlain(source_, cast);
      }
    }
  }

private:
  static constexpr std::size_t kMost = 16;

  CastSource& source_;
  std::size_t next_ = 0, count_ = 0;
  CastRequest requests_[kMost];
};

/// A search on its way. `Interval` is a kernel's form of the piece of the ray inside the child.
template <class Kernel>
struct WideSearch
{
  /// Children of a treelet that wait to be searched; the nearest has the highest bit.
  struct alignas(64) Left
  {
    float from[16], to[16];
    std::uint32_t children[16];
    unsigned lanes;
  };

  UnitCast cast;
  Kernel kernel;
  Candidates candidates;
  std::uint32_t child;
  unsigned depth;
  Left stack[KdTree::kMaxDepth / 4 + 2]; ///< none of them without a child, but one behind the top

  /// The place for children of a treelet. Whether there are any is as good as random: no branch.
  Left& putBy(unsigned lanes)
  {
    Left& top = stack[depth];
    top.lanes = lanes;
    depth += lanes != 0 ? 1 : 0;
    return top;
  }

  /// Takes the next search; false if there is none.
  bool start(CastSource& source, CastQueue& queue)
  {
    if (!queue.next(cast))
    {
      return false;
    }
    if (cast.isShared)
    {
      source.begin(cast);
    }
    child = cast.tree->root();
    depth = 0;
    candidates.count = 0;
    kernel.start(cast);
    return true;
  }

  /// One treelet or leaf; false at the end.
  __attribute__((always_inline)) bool step(CastSource& source)
  {
    if ((child & Treelet::kLeaf) == 0)
    {
      kernel.stepInto(cast.tree->treelets()[child], *this);
    }
    else
    {
      testLeaf(source, cast.tree->blocks() + (child & ~Treelet::kLeaf));
    }
    return takeFromStack(source);
  }

private:
  /// It will be read when the other search has made its step.
  void prefetchChild() const
  {
    if ((child & Treelet::kLeaf) == 0)
    {
      const auto* next = reinterpret_cast<const char*>(cast.tree->treelets() + child);
      _mm_prefetch(next, _MM_HINT_T0);
      _mm_prefetch(next + 64, _MM_HINT_T0);
      _mm_prefetch(next + 128, _MM_HINT_T0);
    }
    else
    {
      const auto* next =
        reinterpret_cast<const char*>(cast.tree->blocks() + (child & ~Treelet::kLeaf));
      _mm_prefetch(next, _MM_HINT_T0);
      _mm_prefetch(next + 64, _MM_HINT_T0);
      _mm_prefetch(next + 128, _MM_HINT_T0);
      _mm_prefetch(next + 192, _MM_HINT_T0);
      _mm_prefetch(next + 256, _MM_HINT_T0);
    }
  }

  void testLeaf(CastSource& source, const TriangleBlock* block)
  {
    for (bool goesOn = true; goesOn; ++block)
    {
      goesOn = !block->isLast();
      const BlockAnswer answer = askBlock(*block, cast);
      if (answer.possible != 0)
      {
        cast.tree->isStretched() ? testAll(source, *block, answer.possible)
                                 : take(source, *block, answer);
      }
    }
  }

  void testAll(CastSource& source, const TriangleBlock& block, unsigned found)
  {
    for (; found != 0; found &= found - 1)
    {
      source.test(cast, block.reference(static_cast<unsigned>(__builtin_ctz(found))));
    }
  }

  void take(CastSource& source, const TriangleBlock& block, const BlockAnswer& answer)
  {
    alignas(32) float distances[8], sizes[8], blurs[8];
    _mm256_store_ps(distances, answer.distance);
    _mm256_store_ps(sizes, answer.size);
    _mm256_store_ps(blurs, answer.blur);
    for (unsigned found = answer.possible; found != 0; found &= found - 1)
    {
      const auto lane = static_cast<unsigned>(__builtin_ctz(found));
      if (candidates.count == Candidates::kMost)
      {
        makeRoom(source);
      }
      candidates.references[candidates.count] = block.reference(lane);
      candidates.distances[candidates.count] = distances[lane] - blurs[lane];
      candidates.sizes[candidates.count++] = sizes[lane] + blurs[lane];
      if ((answer.certain >> lane & 1) != 0)
      {
        lower((distances[lane] + blurs[lane]) / (sizes[lane] - blurs[lane]), source);
      }
    }
  }

  /// Something is hit at this distance or before.
  void lower(float distance, CastSource& source)
  {
    const float limit = distance * (1 + 0x1p-20F) + cast.margin;
    if (limit < cast.limit)
    {
      cast.limit = limit;
      if (cast.isShared)
      {
        source.narrow(cast);
      }
    }
  }

  void makeRoom(CastSource& source)
  {
    candidates.sift(cast.limit);
    for (; candidates.count == Candidates::kMost; candidates.count = 0)
    {
      for (const std::uint32_t reference : candidates.references)
      {
        source.test(cast, reference);
      }
    }
  }

  /// The end of the search.
  bool finish(CastSource& source)
  {
    if (candidates.count > 1)
    {
      candidates.sift(cast.limit);
    }
    source.finish(cast, candidates.references, candidates.count);
    return false;
  }

  bool takeFromStack(CastSource& source)
  {
    if (depth == 0)
    {
      return finish(source);
    }
    Left& top = stack[depth - 1];
    const unsigned lane = 31u - static_cast<unsigned>(__builtin_clz(top.lanes));
    // What lies deeper in the stack is farther away.
    if (top.from[lane] > cast.limit)
    {
      return finish(source);
    }
    top.lanes ^= 1u << lane;
    depth -= top.lanes == 0 ? 1 : 0;
    child = top.children[lane];
    kernel.resume(top.from[lane], top.to[lane]);
    return true;
  }
};

/// Several searches in turns: while one waits for memory, or for the outcome of a long chain of
/// operations, the others compute.
template <class Kernel>
void runInTurns(CastSource& source)
{
  constexpr unsigned kTogether = 4;
  CastQueue queue(source);
  WideSearch<Kernel> searches[kTogether];
  unsigned running = 0;
  while (running < kTogether && searches[running].start(source, queue))
  {
    ++running;
  }
  unsigned ended = kTogether; // the first of them that found no successor
  while (running == kTogether && ended == kTogether)
  {
#pragma GCC unroll 4
    for (unsigned i = 0; i < kTogether; ++i)
    {
      if (__builtin_expect(!searches[i].step(source), 0) && !searches[i].start(source, queue))
      {
        ended = i;
        break;
      }
    }
  }
  for (unsigned i = 0; i < running; ++i)
  {
    while (i != ended && searches[i].step(source))
    {
    }
  }
}

}
}
