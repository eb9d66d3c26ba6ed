#include "CastCounts.h"
#include "KdTree.h"
#include "PaddedRay.h"
#include "UnitCast.h"

#include <algorithm>
#include <cmath>

namespace irradiance
{

namespace
{

/// Walks down the treelets plane by plane, in double.
class PlainSearch
{
public:
  PlainSearch(CastSource& source, UnitCast& cast)
    : source_(source)
    , cast_(cast)
    , tree_(*cast.tree)
    , ray_(tree_.bounds(), cast.exactOrigin, cast.exactDirection)
  {
  }

  void run()
  {
    const Entry root{ tree_.root(), 1, std::max(cast_.from, ray_.from), ray_.to };
    if (root.from <= root.to)
    {
      stack_[depth_++] = root;
    }
    while (depth_ > 0)
    {
      const Entry entry = stack_[--depth_];
      if (entry.from <= cast_.exactLimit)
      {
        descend(entry);
      }
    }
    if (castCounts())
    {
      *castCounts() += counts_;
    }
  }

private:
  struct Entry
  {
    std::uint32_t child; ///< as in a treelet
    unsigned node;       ///< in the treelet
    double from, to;
  };

  /// From an entry to its nearest leaf; what is farther goes on the stack.
  void descend(Entry entry)
  {
    while ((entry.child & Treelet::kLeaf) == 0)
    {
      const Treelet& treelet = tree_.treelets()[entry.child];
      counts_.treelets += entry.node == 1 ? 1 : 0;
      if (entry.node >= 16)
      {
        entry.child = treelet.children[entry.node - 16];
        entry.node = 1;
        continue;
      }
      const std::uint32_t axis = treelet.axis(entry.node);
      if (axis == Treelet::kNoPlane)
      {
        entry.node *= 2;
        continue;
      }
      stepOver(ray_.axes[axis], treelet.plane(entry.node), entry);
    }
    if (entry.child != Treelet::kEmpty)
    {
      testLeaf(tree_.blocks() + (entry.child & ~Treelet::kLeaf));
    }
  }

  void stepOver(const PaddedRay::Axis& axis, float place, Entry& entry)
  {
    const double plane = (place - axis.origin) * axis.inverse;
    const unsigned near = 2 * entry.node + axis.nearChild;
    if (plane - axis.pad > entry.to)
    {
      entry.node = near;
    }
    else if (plane + axis.pad < entry.from)
    {
      entry.node = near ^ 1;
    }
    else
    {
      stack_[depth_++] = { entry.child, near ^ 1, std::max(entry.from, plane - axis.pad),
        entry.to };
      entry.to = std::min(entry.to, plane + axis.pad);
      entry.node = near;
    }
  }

  void testLeaf(const TriangleBlock* block)
  {
    for (bool goesOn = true; goesOn; ++block)
    {
      goesOn = !block->isLast();
      ++counts_.blocks;
      for (unsigned lane = 0; lane < TriangleBlock::kSize; ++lane)
      {
        if (block->reference(lane) != TriangleBlock::kNone &&
          block->reference(lane) != cast_.skipped && !misses(*block, lane))
        {
          source_.test(cast_, block->reference(lane));
        }
      }
    }
  }

  /// As the other kernels reject triangles, if floats can.
  bool misses(const TriangleBlock& block, unsigned lane) const;

  CastSource& source_;
  UnitCast& cast_;
  const TriangleTree& tree_;
  PaddedRay ray_;
  CastCounts counts_;
  int depth_ = 0;
  Entry stack_[KdTree::kMaxDepth + 2];
};

bool PlainSearch::misses(const TriangleBlock& block, unsigned lane) const
{
  if (!cast_.isForFloats)
  {
    return false;
  }
  using Vector3f = Eigen::Vector3f;
  const auto at = [lane](const float(&values)[3][TriangleBlock::kSize]) {
    return Vector3f(values[0][lane], values[1][lane], values[2][lane]);
  };
  const Vector3f origin(cast_.origin[0], cast_.origin[1], cast_.origin[2]);
  const Vector3f direction(cast_.direction[0], cast_.direction[1], cast_.direction[2]);
  const Vector3f toCorner = at(block.corner) - origin, edge1 = at(block.edge1),
                 edge2 = at(block.edge2);
  const Vector3f normal = edge1.cross(edge2), moment = toCorner.cross(direction);
  const float determinant = normal.dot(direction);
  const float sign = std::copysign(1.0F, determinant), size = std::abs(determinant);
  const float u = sign * moment.dot(edge2), v = -sign * moment.dot(edge1);
  const float length = edge1.lpNorm<1>() + edge2.lpNorm<1>();
  const float blur = cast_.edgeBlur * length + cast_.leastBlur;
  if (u < -blur || v < -blur || u + v > size + blur)
  {
    return true;
  }
  const float distance = sign * normal.dot(toCorner);
  const float distanceBlur = length * (UnitCast::kSizeBlur * length + cast_.leastBlur);
  return distance < -(distanceBlur + size * cast_.slack) ||
    distance > size * cast_.limit + distanceBlur;
}

}

void runCastPlain(CastSource& source, UnitCast& cast)
{
  PlainSearch(source, cast).run();
}

void runCastsPlain(CastSource& source)
{
  CastRequest request;
  UnitCast cast;
  while (source.next(&request, 1) != 0)
  {
    if (cast.prepare(request))
    {
      runCastPlain(source, cast);
    }
  }
}

}
