// SPDX-License-Identifier: BSD-3-Clause
#include "Kernels/FrontStages.h"
#include "Kernels/QueryCounts.h"
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
  ExactSearch(
    const TriangleTree& tree, const TreeRays& rays, std::uint32_t ray, FrontTester& tester)
    : tree_(tree)
    , tester_(tester)
    , ray_(ray)
    , skipped_(rays.skipped(ray, TriangleBlock::kNone))
    , best_(rays.distance[ray])
    , rate_(largestOf(rays, ray) * tree.frame().scale)
    , padded_(tree.bounds(), tree.frame()(originOf(rays, ray)),
        directionOf(rays, ray) / largestOf(rays, ray))
    , octant_(
        padded_.axes[0].nearChild | padded_.axes[1].nearChild << 1 | padded_.axes[2].nearChild << 2)
  {
  }

  void run()
  {
    setLimit();
    push(tree_.root(), std::max(0.0, padded_.from), padded_.to);
    while (depth_ > 0)
    {
      const Entry entry = stack_[--depth_];
      if (entry.from <= limit_)
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
    std::fill_n(from, Treelet::kSize, 0.0);
    std::fill_n(to, Treelet::kSize, limit_);
    for (int i = 0; i < 3; ++i)
    {
      const PaddedRay::Axis& axis = padded_.axes[i];
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
        if (block->reference(lane) != TriangleBlock::kNone && block->reference(lane) != skipped_)
        {
          tester_.test(ray_, block->reference(lane));
          setLimit();
        }
      }
    }
  }

  void setLimit() { limit_ = best_ * rate_ + tree_.slack(); }

  static double largestOf(const TreeRays& rays, std::uint32_t ray)
  {
    return directionOf(rays, ray).cwiseAbs().maxCoeff();
  }

  const TriangleTree& tree_;
  FrontTester& tester_;
  std::uint32_t ray_, skipped_;
  const double& best_; ///< the distance of the best hit so far
  double rate_;        ///< length in the frame, by the largest component, of one unit of distance
  double limit_ = 0;   ///< nothing behind it matters, in the frame
  PaddedRay padded_;
  unsigned octant_;
  QueryCounts counts_;
  int depth_ = 0;
  Entry stack_[(KdTree::kMaxDepth + 1) * (Treelet::kSize - 1) + 2];
};

}

void searchExactly(
  const TriangleTree& tree, const TreeRays& rays, std::uint32_t ray, FrontTester& tester)
{
  ExactSearch(tree, rays, ray, tester).run();
}

}
