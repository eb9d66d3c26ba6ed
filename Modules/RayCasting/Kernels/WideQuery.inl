// SPDX-License-Identifier: BSD-3-Clause
// No include guard: each kernel includes it once, between the marks of its target, after
// "Kernels/TreeQuery.h" and the other headers it uses. Kernels name their lanes twice: `Boxes` for
// the boxes of a treelet, `Lanes` for triangles.

#include "Kernels/FrontQueue.inl"
#include "Kernels/WideBlock.inl"

namespace irradiance
{
namespace
{

/// Offsets, in the bounds of a treelet, of the faces at which a ray enters and leaves boxes.
struct BoxFaces
{
  unsigned near[3], far[3], behind;

  void start(unsigned octant, int behindAxis)
  {
    for (unsigned axis = 0; axis < 3; ++axis)
    {
      const unsigned isNegative = octant >> axis & 1;
      near[axis] = (3 * isNegative + axis) * Treelet::kSize;
      far[axis] = (3 * (1 - isNegative) + axis) * Treelet::kSize;
    }
    behind = far[behindAxis];
  }
};

/// Where a ray passes planes.
template <class Boxes>
inline typename Boxes::Floats pass(const float* planes, const TreeQuery& query, int axis)
{
  return Boxes::mulSubtract(
    Boxes::load(planes), Boxes::all(query.inverse[axis]), Boxes::all(query.originInverse[axis]));
}

/// Writes to `from` where the ray enters the boxes of a treelet; returns the ones it passes, one
/// bit each, from far to near.
template <class Boxes>
inline unsigned enter(
  const Treelet& treelet, const BoxFaces& faces, const TreeQuery& query, float* from)
{
  using Floats = typename Boxes::Floats;
  typename Boxes::Mask passed[Treelet::kSize / Boxes::kCount];
  for (unsigned first = 0; first < Treelet::kSize; first += Boxes::kCount)
  {
    const float* const planes = &treelet.bounds[0][0][0] + first;
    const Floats begin = Boxes::most(Boxes::most(pass<Boxes>(planes + faces.near[0], query, 0),
                                       pass<Boxes>(planes + faces.near[1], query, 1)),
      Boxes::most(pass<Boxes>(planes + faces.near[2], query, 2), Boxes::all(0)));
    const Floats end = Boxes::least(Boxes::least(pass<Boxes>(planes + faces.far[0], query, 0),
                                      pass<Boxes>(planes + faces.far[1], query, 1)),
      Boxes::least(pass<Boxes>(planes + faces.far[2], query, 2), Boxes::all(query.limit)));
    Boxes::store(from + first, begin);
    const Floats reach =
      Boxes::flip(Boxes::load(planes + faces.behind), Boxes::all(query.behindSign));
    passed[first / Boxes::kCount] = Boxes::both(Boxes::isAtMost(begin, end + Boxes::all(query.pad)),
      Boxes::isLess(Boxes::all(query.behind), reach));
  }
  return Boxes::ordered(passed, treelet.farToNear[query.octant]);
}

/// A running search. Its steps are inlined even if the compiler would rather not: calls cost a
/// tenth of a frame's shooting.
template <class Boxes, class Lanes, bool isCounted>
struct WideSearch
{
  /// The children of a treelet that are still to be searched.
  struct alignas(64) Left
  {
    float from[Treelet::kSize];
    const Treelet* treelet;
    unsigned lanes; ///< one bit for each such child, in the order from far to near
  };

  TreeQuery query;
  BoxFaces faces;
  Candidates candidates;
  std::uint64_t blocks = 0; ///< that all searches of this object tested
  std::uint32_t child;
  unsigned depth;
  /// Each has a child left, except the first, which ends the search, and the one beyond the top.
  Left stack[KdTree::kMaxDepth + 3];

  /// Takes the next search; false if there is none.
  __attribute__((always_inline)) bool start(FrontQueue& queue)
  {
    if (!queue.next(query))
    {
      return false;
    }
    child = query.tree->root();
    depth = 1;
    stack[0].lanes = 0;
    stack[0].treelet = nullptr;
    candidates.count = 0;
    faces.start(query.octant, query.behindAxis);
    return true;
  }

  /// Searches one treelet or leaf; false at the end.
  __attribute__((always_inline)) bool step(FrontQueue& queue)
  {
    if ((child & Treelet::kLeaf) == 0)
    {
      const Treelet& treelet = query.tree->treelets()[child];
      Left& top = stack[depth];
      top.treelet = &treelet;
      const unsigned lanes = enter<Boxes>(treelet, faces, query, top.from);
      // Whether the ray passes any is unpredictable, so there is no branch. The entry below in the
      // stack has been read long before that is known.
      const bool isAny = lanes != 0;
      Left& below = stack[depth - 1];
      const unsigned belowLanes = below.lanes;
      depth -= isAny ? 0 : 1;
      return descend(queue, *(isAny ? &top : &below), isAny ? &treelet : below.treelet,
        isAny ? lanes : belowLanes);
    }
    testLeaf(queue, query.tree->blocks() + (child & ~Treelet::kLeaf));
    --depth;
    return descend(queue, stack[depth], stack[depth].treelet, stack[depth].lanes);
  }

private:
  /// Continues with the nearest child that is left in the top of the stack, at `depth`; false if
  /// the search ends before it.
  __attribute__((always_inline)) bool descend(
    FrontQueue& queue, Left& top, const Treelet* treelet, unsigned lanes)
  {
    if (lanes == 0)
    {
      return finish(queue);
    }
    const unsigned place = 31u - static_cast<unsigned>(__builtin_clz(lanes));
    const unsigned lane = treelet->farToNear[query.octant][place];
    // What lies deeper in the stack is farther away.
    if (top.from[lane] > query.limit)
    {
      return finish(queue);
    }
    top.lanes = lanes ^ 1u << place;
    depth += top.lanes != 0 ? 1 : 0;
    child = treelet->children[lane];
    prefetchChild();
    return true;
  }

  /// The other searches take their steps before this one reads its child.
  __attribute__((always_inline)) void prefetchChild() const
  {
    constexpr std::size_t kLine = 64;
    const bool isLeaf = (child & Treelet::kLeaf) != 0;
    const auto* memory = isLeaf
      ? reinterpret_cast<const char*>(query.tree->blocks() + (child & ~Treelet::kLeaf))
      : reinterpret_cast<const char*>(query.tree->treelets() + child);
    for (std::size_t place = 0; place < sizeof(TriangleBlock); place += kLine)
    {
      prefetchLine(memory + place);
    }
  }

  __attribute__((always_inline)) void testLeaf(FrontQueue& queue, const TriangleBlock* block)
  {
    for (bool hasMore = true; hasMore; ++block)
    {
      hasMore = !block->isLast();
      if constexpr (isCounted)
      {
        ++blocks;
      }
      for (unsigned first = 0; first < TriangleBlock::kSize; first += Lanes::kCount)
      {
        const BlockResult<Lanes> result = testBlock<Lanes>(*block, first, query);
        if (result.possible != 0)
        {
          query.tree->isIllConditioned() ? testAll(queue, *block, result.possible << first)
                                         : take(queue, *block, first, result);
        }
      }
    }
  }

  void testAll(FrontQueue& queue, const TriangleBlock& block, unsigned found)
  {
    for (; found != 0; found &= found - 1)
    {
      queue.test(query, block.reference(static_cast<unsigned>(__builtin_ctz(found))));
    }
  }

  void take(
    FrontQueue& queue, const TriangleBlock& block, unsigned first, const BlockResult<Lanes>& result)
  {
    alignas(32) float distances[Lanes::kCount], sizes[Lanes::kCount], blurs[Lanes::kCount];
    Lanes::store(distances, result.distance);
    Lanes::store(sizes, result.size);
    Lanes::store(blurs, result.blur);
    for (unsigned found = result.possible; found != 0; found &= found - 1)
    {
      const auto lane = static_cast<unsigned>(__builtin_ctz(found));
      if (candidates.count == Candidates::kMost)
      {
        makeRoom(queue);
      }
      candidates.references[candidates.count] = block.reference(first + lane);
      candidates.distances[candidates.count] = distances[lane] - blurs[lane];
      candidates.sizes[candidates.count++] = sizes[lane] + blurs[lane];
      if ((result.certain >> lane & 1) != 0)
      {
        lower((distances[lane] + blurs[lane]) / (sizes[lane] - blurs[lane]));
      }
    }
  }

  /// Lowers the limit: something is hit at this distance or before.
  void lower(float distance)
  {
    const float limit = distance * (1 + 0x1p-20F) + query.margin;
    query.limit = limit < query.limit ? limit : query.limit;
  }

  void makeRoom(FrontQueue& queue)
  {
    candidates.sift(query.limit);
    for (; candidates.count == Candidates::kMost; candidates.count = 0)
    {
      for (const std::uint32_t reference : candidates.references)
      {
        queue.test(query, reference);
      }
    }
  }

  /// Ends the search and hands over its candidates.
  bool finish(FrontQueue& queue)
  {
    if (candidates.count > 1)
    {
      candidates.sift(query.limit);
    }
    queue.finish(query, candidates.references, candidates.count);
    return false;
  }
};

/// Runs several searches in turns: while one waits for memory, or for the result of a long chain of
/// operations, the others compute.
template <class Boxes, class Lanes, bool isCounted>
void runInTurns(FrontQueue& queue)
{
  constexpr unsigned kSearches = 4;
  WideSearch<Boxes, Lanes, isCounted> searches[kSearches];
  unsigned running = 0;
  while (running < kSearches && searches[running].start(queue))
  {
    ++running;
  }
  unsigned ended = kSearches; // the first one that found no next search
  while (running == kSearches && ended == kSearches)
  {
#pragma GCC unroll 4
    for (unsigned i = 0; i < kSearches; ++i)
    {
      if (__builtin_expect(!searches[i].step(queue), 0) && !searches[i].start(queue))
      {
        ended = i;
        break;
      }
    }
  }
  for (unsigned i = 0; i < running; ++i)
  {
    while (i != ended && searches[i].step(queue))
    {
    }
    if constexpr (isCounted)
    {
      *countedBlocks() += searches[i].blocks;
    }
  }
}

/// Runs all searches. Counts if this thread's searches are counted.
template <class Boxes, class Lanes>
void runSearches(FrontSearches& searches)
{
  FrontQueue queue(searches);
#ifdef VTKIRRADIANCE_COUNT_QUERIES
  if (countedBlocks())
  {
    runInTurns<Boxes, Lanes, true>(queue);
    return;
  }
#endif
  runInTurns<Boxes, Lanes, false>(queue);
}

}
}
