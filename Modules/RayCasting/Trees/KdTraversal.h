// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_KdTraversal_h
#define irradiance_KdTraversal_h

#include "Trees/KdTree.h"
#include "Trees/PaddedRay.h"

#include <algorithm>

namespace irradiance
{

/**
 * Visits the leaves that a ray passes, front to back, one at a time.
 *
 * Law: no leaf that holds the closest hit is skipped. Rounding in the intersection test lets a ray
 * "hit" a triangle that it misses by a few ulps, and gives a distance that is off when the ray
 * grazes: by up to 2^-10 of the triangle for the flattest hits that count. So all cells are widened
 * by `pad` (2^-36 of the distance to the tree's far corner), and the search ends only 2^-8 of that
 * distance behind the best hit. Both cost almost nothing. Documentation/Theory.md has the reasons.
 */
class KdTraversal
{
public:
  /// How far behind a hit the search continues for closer ones, in units of the reach.
  static constexpr double kSlack = 0x1p-8;

  KdTraversal(const KdTree& tree, const Vector3& origin, const Vector3& direction)
    : nodes_(tree.nodes.data())
    , references_(tree.references.data())
    , ray_(tree.bounds, origin, direction)
  {
    slack_ = kSlack * ray_.reach / direction.cwiseAbs().maxCoeff();
    const double from = std::max(ray_.from, 0.0);
    if (!tree.isEmpty() && from <= ray_.to)
    {
      stack_[depth_++] = { 0, from, ray_.to };
    }
  }

  /// A leaf that begins behind this holds nothing closer than a hit at `distance`.
  double limit(double distance) const { return distance + slack_; }

  /// Moves to the next leaf that is not empty and begins before `limit`; false if there is none.
  bool advance(double limit)
  {
    while (depth_ > 0)
    {
      --depth_;
      if (stack_[depth_].from <= limit && descend())
      {
        return true;
      }
    }
    return false;
  }

  /// The references of the leaf that advance() reached.
  const std::uint32_t* begin() const { return leafBegin_; }
  const std::uint32_t* end() const { return leafEnd_; }

private:
  struct Entry
  {
    std::uint32_t node;
    double from, to;
  };

  /// Descends from the entry on top of the stack to its nearest leaf; false if that is empty.
  bool descend()
  {
    double from = stack_[depth_].from, to = stack_[depth_].to;
    const KdNode* node = nodes_ + stack_[depth_].node;
    while (!node->isLeaf())
    {
      const PaddedRay::Axis& axis = ray_.axes[node->axis()];
      const double plane = (node->plane - axis.origin) * axis.inverse;
      const std::uint32_t near = node->index() + axis.nearChild;
      if (plane - axis.pad > to)
      {
        node = nodes_ + near;
      }
      else if (plane + axis.pad < from)
      {
        node = nodes_ + (near ^ 1);
      }
      else
      {
        Entry& far = stack_[depth_++];
        far.node = near ^ 1;
        far.from = std::max(from, plane - axis.pad);
        far.to = to;
        to = std::min(to, plane + axis.pad);
        node = nodes_ + near;
      }
    }
    leafBegin_ = references_ + node->index();
    leafEnd_ = leafBegin_ + node->count;
    return node->count > 0;
  }

  const KdNode* nodes_;
  const std::uint32_t* references_;
  PaddedRay ray_;
  double slack_ = 0;
  const std::uint32_t* leafBegin_ = nullptr;
  const std::uint32_t* leafEnd_ = nullptr;
  int depth_ = 0;
  Entry stack_[KdTree::kMaxDepth + 2];
};

}

#endif
