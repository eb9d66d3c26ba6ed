// SPDX-License-Identifier: BSD-3-Clause
// No include guard: a part of WideQuery.inl.

namespace irradiance
{
namespace
{

/// The searches that PrepareLanes has prepared, one after the other, and where they leave what they
/// find.
class FrontQueue
{
public:
  explicit FrontQueue(FrontSearches& front)
    : front_(front)
  {
    const TriangleTree& tree = front.tree;
    common_.tree = &tree;
    common_.slack = static_cast<float>(tree.slack() + TreeQuery::kBlur);
    common_.edgeBlur = static_cast<float>(TreeQuery::kEdgeBlur + 4 * tree.blur());
    common_.leastBlur = static_cast<float>(TreeQuery::kLeastBlur + 32 * tree.blur());
  }

  /// The next search; false if there is none.
  __attribute__((always_inline)) bool next(TreeQuery& query)
  {
    if (next_ == front_.count)
    {
      return false;
    }
    query = common_;
    static_cast<PreparedQuery&>(query) = front_.queries[next_++];
    // Half a pad for the entry of a box, two for its order; see Documentation/Theory.md.
    query.margin = query.slack + 3 * query.pad;
    query.behindSign = __builtin_copysignf(0.0F, query.direction[query.behindAxis]);
    query.octant = signOf(query.direction[0]) | signOf(query.direction[1]) << 1 |
      signOf(query.direction[2]) << 2;
    return true;
  }

  __attribute__((always_inline)) void finish(
    const TreeQuery& query, const std::uint32_t* references, unsigned count)
  {
    if (count == 0)
    {
      return;
    }
    front_.candidate[query.ray] = references[0];
    front_.corners.prefetch(references[0]);
    if (__builtin_expect(count > 1, 0))
    {
      addFurther(query.ray, references, count);
    }
  }

  void test(const TreeQuery& query, std::uint32_t reference)
  {
    front_.tester.test(query.ray, reference);
  }

private:
  __attribute__((always_inline)) static unsigned signOf(float x)
  {
    std::uint32_t bits;
    std::memcpy(&bits, &x, sizeof(bits));
    return bits >> 31;
  }

  void addFurther(std::uint32_t ray, const std::uint32_t* references, unsigned count)
  {
    for (unsigned i = 1; i < count; ++i)
    {
      if (front_.furtherCount < front_.furtherRoom)
      {
        front_.further[front_.furtherCount++] = { ray, references[i] };
      }
      else
      {
        front_.tester.test(ray, references[i]);
      }
    }
  }

  FrontSearches& front_;
  std::uint32_t next_ = 0;
  TreeQuery common_{}; ///< what all have in common
};

}
}
