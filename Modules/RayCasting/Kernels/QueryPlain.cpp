// SPDX-License-Identifier: BSD-3-Clause
#include "Kernels/QueryCounts.h"
#include "Kernels/TreeQuery.h"
#include "Trees/KdTree.h"
#include "Trees/PaddedRay.h"

#include <algorithm>
#include <cmath>

namespace irradiance
{

namespace
{

/// Searches the treelets in double.
class PlainSearch
{
public:
  PlainSearch(QuerySource& source, TreeQuery& query)
    : source_(source)
    , query_(query)
    , tree_(*query.tree)
    , ray_(tree_.bounds(), query.exactOrigin, query.exactDirection)
    , octant_(ray_.axes[0].nearChild | ray_.axes[1].nearChild << 1 | ray_.axes[2].nearChild << 2)
  {
  }

  void run()
  {
    push(tree_.root(), std::max(query_.from, ray_.from), ray_.to);
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
    std::fill_n(from, Treelet::kSize, query_.from);
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
      // From a distant origin even the boxes of empty lanes seem to be near the others.
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
          block->reference(lane) != query_.skipped && !misses(*block, lane))
        {
          source_.test(query_, block->reference(lane));
        }
      }
    }
  }

  /// Rejects triangles as the other kernels do, where floats can.
  bool misses(const TriangleBlock& block, unsigned lane) const;

  QuerySource& source_;
  TreeQuery& query_;
  const TriangleTree& tree_;
  PaddedRay ray_;
  unsigned octant_;
  QueryCounts counts_;
  int depth_ = 0;
  Entry stack_[(KdTree::kMaxDepth + 1) * (Treelet::kSize - 1) + 2];
};

bool PlainSearch::misses(const TriangleBlock& block, unsigned lane) const
{
  if (!query_.isForFloats)
  {
    return false;
  }
  using Vector3f = Eigen::Vector3f;
  const auto at = [lane](const float(&values)[3][TriangleBlock::kSize]) {
    return Vector3f(values[0][lane], values[1][lane], values[2][lane]);
  };
  const Vector3f origin(query_.origin[0], query_.origin[1], query_.origin[2]);
  const Vector3f direction(query_.direction[0], query_.direction[1], query_.direction[2]);
  const Vector3f toCorner = at(block.corner) - origin, edge1 = at(block.edge1),
                 edge2 = at(block.edge2);
  const Vector3f normal = edge1.cross(edge2), moment = toCorner.cross(direction);
  const float determinant = normal.dot(direction);
  const float sign = std::copysign(1.0F, determinant), size = std::abs(determinant);
  const float u = sign * moment.dot(edge2), v = -sign * moment.dot(edge1);
  const float length = edge1.lpNorm<1>() + edge2.lpNorm<1>();
  const float blur = query_.edgeBlur * length + query_.leastBlur;
  if (u < -blur || v < -blur || u + v > size + blur)
  {
    return true;
  }
  const float distance = sign * normal.dot(toCorner);
  const float distanceBlur = length * (TreeQuery::kSizeBlur * length + query_.leastBlur);
  return distance < -(distanceBlur + size * query_.slack) ||
    distance > size * query_.limit + distanceBlur;
}

}

void runQueryPlain(QuerySource& source, TreeQuery& query)
{
  PlainSearch(source, query).run();
}

void runQueriesPlain(QuerySource& source)
{
  QueryRequest request;
  TreeQuery query;
  while (source.next(&request, 1) != 0)
  {
    if (query.prepare(request))
    {
      runQueryPlain(source, query);
    }
  }
}

}
