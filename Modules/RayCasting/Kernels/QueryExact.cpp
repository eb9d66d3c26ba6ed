// SPDX-License-Identifier: BSD-3-Clause
#include "Kernels/QueryCounts.h"
#include "Kernels/TreeQuery.h"
#include "Trees/KdTree.h"
#include "Trees/PaddedRay.h"

#include <algorithm>

namespace irradiance
{

namespace
{

/// Searches the treelets in double, and rejects no triangle by floats.
class ExactSearch
{
public:
  ExactSearch(QuerySource& source, const QueryRequest& request)
    : source_(source)
    , tree_(*request.tree)
    , query_(exactQuery(request))
    , from_(query_.from(request))
    , ray_(tree_.bounds(), tree_.frame()(request.origin), request.direction / largestOf(request))
    , octant_(ray_.axes[0].nearChild | ray_.axes[1].nearChild << 1 | ray_.axes[2].nearChild << 2)
  {
  }

  void run()
  {
    push(tree_.root(), std::max(from_, ray_.from), ray_.to);
    while (depth_ > 0)
    {
      const Entry entry = stack_[--depth_];
      if (entry.from <= query_.exactLimit)
      {
        (entry.child & Treelet::kLeaf) == 0
          ? stepInto(tree_.treelets()[entry.child])
          : testLeaf(tree_.blocks() + (entry.child & ~Treelet::kLeaf));
      }
    }
    if (queryCounts())
    {
      *queryCounts() += counts_;
    }
  }

private:
  struct Entry
  {
    std::uint32_t child; ///< as in a treelet
    double from;
  };

  void push(std::uint32_t child, double from, double to)
  {
    if (from <= to)
    {
      stack_[depth_++] = { child, from };
    }
  }

  /// Pushes the boxes that the ray passes, from far to near.
  void stepInto(const Treelet& treelet)
  {
    ++counts_.treelets;
    double from[Treelet::kSize], to[Treelet::kSize];
    std::fill_n(from, Treelet::kSize, from_);
    std::fill_n(to, Treelet::kSize, query_.exactLimit);
    for (int i = 0; i < 3; ++i)
    {
      const PaddedRay::Axis& axis = ray_.axes[i];
      const float* near = treelet.bounds[axis.nearChild][i];
      const float* far = treelet.bounds[1 - axis.nearChild][i];
      for (unsigned lane = 0; lane < Treelet::kSize; ++lane)
      {
        from[lane] = std::max(from[lane], (near[lane] - axis.origin) * axis.inverse - axis.pad);
        to[lane] = std::min(to[lane], (far[lane] - axis.origin) * axis.inverse + axis.pad);
      }
    }
    for (const unsigned lane : treelet.farToNear[octant_])
    {
      // From a distant origin even the boxes of empty lanes seem to lie near the used ones.
      if (treelet.children[lane] != Treelet::kEmpty)
      {
        push(treelet.children[lane], from[lane], to[lane]);
      }
    }
  }

  void testLeaf(const TriangleBlock* block)
  {
    for (bool hasMore = true; hasMore; ++block)
    {
      hasMore = !block->isLast();
      ++counts_.blocks;
      for (unsigned lane = 0; lane < TriangleBlock::kSize; ++lane)
      {
        if (block->reference(lane) != TriangleBlock::kNone &&
          block->reference(lane) != query_.skipped)
        {
          source_.test(query_, block->reference(lane));
        }
      }
    }
  }

  static double largestOf(const QueryRequest& request)
  {
    return request.direction.cwiseAbs().maxCoeff();
  }
  static TreeQuery exactQuery(const QueryRequest& request)
  {
    TreeQuery query;
    query.set(request, largestOf(request));
    query.isForFloats = false;
    query.setBound(request.bound);
    return query;
  }

  QuerySource& source_;
  const TriangleTree& tree_;
  TreeQuery query_;
  double from_; ///< no hit comes before it
  PaddedRay ray_;
  unsigned octant_;
  QueryCounts counts_;
  int depth_ = 0;
  Entry stack_[(KdTree::kMaxDepth + 1) * (Treelet::kSize - 1) + 2];
};

}

void runQueryExact(QuerySource& source, const QueryRequest& request)
{
  ExactSearch(source, request).run();
}

}
