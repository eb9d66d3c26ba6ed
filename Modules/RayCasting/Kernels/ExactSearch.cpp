// SPDX-License-Identifier: BSD-3-Clause
#include "Kernels/CountedBlocks.h"
#include "Kernels/FrontStages.h"
#include "Trees/KdTreeBuilder.h"

#include <algorithm>
#include <utility>

namespace irradiance
{

namespace
{

/// A ray as a kd-tree traversal in double needs it. All cells are widened by `pad`, 2^-36 of the
/// reach, which is far more than any rounding. Documentation/Theory.md has the reasons.
struct PaddedRay
{
  double origin[3];
  double inverse[3]; ///< of the direction
  double pad[3];     ///< on the ray
  unsigned nearChild[3];
  double from = -kInfinity, to = kInfinity; ///< the part inside the box

  PaddedRay(const Box& box, const Vector3& start, const Vector3& direction)
  {
    constexpr double kParallel = 1e-150;
    // From the start to the far corner of the box, by the largest component.
    const double reach = std::max(
      (box.lower - start).cwiseAbs().maxCoeff(), (box.upper - start).cwiseAbs().maxCoeff());
    for (int i = 0; i < 3; ++i)
    {
      origin[i] = start[i];
      inverse[i] = std::abs(direction[i]) < kParallel ? std::copysign(1 / kParallel, direction[i])
                                                      : 1 / direction[i];
      pad[i] = 0x1p-36 * reach * std::abs(inverse[i]);
      nearChild[i] = inverse[i] < 0 ? 1u : 0u;
      const double lower = (box.lower[i] - origin[i]) * inverse[i];
      const double upper = (box.upper[i] - origin[i]) * inverse[i];
      from = std::max(from, std::min(lower, upper) - pad[i]);
      to = std::min(to, std::max(lower, upper) + pad[i]);
    }
  }
};

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
    , octant_(padded_.nearChild[0] | padded_.nearChild[1] << 1 | padded_.nearChild[2] << 2)
  {
  }

  void run()
  {
    setLimit();
    push(tree_.root(), std::max(0.0, padded_.from), padded_.to);
    while (depth_ > 0)
    {
      const auto [child, from] = stack_[--depth_];
      if (from <= limit_)
      {
        (child & Treelet::kLeaf) == 0 ? stepInto(tree_.treelets()[child])
                                      : testLeaf(tree_.blocks() + (child & ~Treelet::kLeaf));
      }
    }
    if (countedBlocks())
    {
      *countedBlocks() += blocks_;
    }
  }

private:
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
    double from[Treelet::kSize], to[Treelet::kSize];
    std::fill_n(from, Treelet::kSize, 0.0);
    std::fill_n(to, Treelet::kSize, limit_);
    for (int i = 0; i < 3; ++i)
    {
      const double origin = padded_.origin[i], inverse = padded_.inverse[i], pad = padded_.pad[i];
      const float* near = treelet.bounds[padded_.nearChild[i]][i];
      const float* far = treelet.bounds[1 - padded_.nearChild[i]][i];
      for (unsigned lane = 0; lane < Treelet::kSize; ++lane)
      {
        from[lane] = std::max(from[lane], (near[lane] - origin) * inverse - pad);
        to[lane] = std::min(to[lane], (far[lane] - origin) * inverse + pad);
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
    const TriangleBlock* const end = forEachListed(block, [&](std::uint32_t reference) {
      if (reference != skipped_)
      {
        tester_.test(ray_, reference);
        setLimit();
      }
    });
    blocks_ += static_cast<std::uint64_t>(end - block);
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
  std::uint64_t blocks_ = 0; ///< that were tested
  int depth_ = 0;
  /// Children, as in treelets, and where the ray enters them.
  std::pair<std::uint32_t, double> stack_[(KdTree::kMaxDepth + 1) * (Treelet::kSize - 1) + 2];
};

}

void searchExactly(
  const TriangleTree& tree, const TreeRays& rays, std::uint32_t ray, FrontTester& tester)
{
  ExactSearch(tree, rays, ray, tester).run();
}

}
