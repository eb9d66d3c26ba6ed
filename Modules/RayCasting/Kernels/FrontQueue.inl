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
    common_.setTree(*front.tree);
  }

  /// The next search; false if there is none.
  __attribute__((always_inline)) bool next(TreeQuery& query)
  {
    if (next_ == front_.count)
    {
      return false;
    }
    const PreparedQuery& prepared = front_.queries[next_++];
    query.tree = common_.tree;
    // What follows each three numbers is not for the lanes of the query, and they do not mind it.
    std::memcpy(query.origin, prepared.origin, sizeof(query.origin));
    std::memcpy(query.direction, prepared.direction, sizeof(query.direction));
    std::memcpy(query.inverse, prepared.inverse, sizeof(query.inverse));
    std::memcpy(query.originInverse, prepared.originInverse, sizeof(query.originInverse));
    query.limit = prepared.limit;
    query.pad = prepared.pad;
    query.slack = common_.slack;
    // Half a pad for the entry of a box, two for its order; see Documentation/Theory.md.
    query.margin = common_.slack + 3 * prepared.pad;
    query.edgeBlur = common_.edgeBlur;
    query.leastBlur = common_.leastBlur;
    query.skipped = prepared.skipped;
    query.behind = prepared.behind;
    query.behindAxis = prepared.behindAxis;
    query.behindSign = __builtin_copysignf(0.0F, prepared.direction[prepared.behindAxis]);
    query.octant = signOf(prepared.direction[0]) | signOf(prepared.direction[1]) << 1 |
      signOf(prepared.direction[2]) << 2;
    query.ray = prepared.ray;
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
    const char* const row = front_.rows + references[0] * front_.rowBytes;
    prefetchLine(row);
    prefetchLine(row + front_.cornerBytes - 1);
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
  TreeQuery common_; ///< what all have in common
};

}
}
