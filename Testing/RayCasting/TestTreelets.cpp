// SPDX-License-Identifier: BSD-3-Clause
#include "KdTreeWalk.h"
#include "TestMeshes.h"
#include "Trees/TreeletPlan.h"
#include "Trees/TriangleTree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <utility>

// The boxes of treelets are nested, can be searched from near to far, and are as few and as small
// as possible.

namespace irradiance
{
namespace
{

using test::build;
using test::NamedMesh;

class TreeletsOfMesh : public testing::TestWithParam<NamedMesh>
{
};

/// Calls visit(treelet, lane) for each child of a treelet.
template <typename Visit>
void forEachChild(const TriangleTree& tree, std::uint32_t node, const Visit& visit)
{
  if ((node & Treelet::kLeaf) != 0)
  {
    return;
  }
  const Treelet& treelet = tree.treelets()[node];
  for (unsigned lane = 0; lane < Treelet::kSize; ++lane)
  {
    if (treelet.children[lane] != Treelet::kEmpty)
    {
      visit(treelet, lane);
      forEachChild(tree, treelet.children[lane], visit);
    }
  }
}

bool isWithin(const Treelet& treelet, unsigned lane, const Treelet& other, unsigned otherLane)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (treelet.bounds[0][axis][lane] < other.bounds[0][axis][otherLane] ||
      treelet.bounds[1][axis][lane] > other.bounds[1][axis][otherLane])
    {
      return false;
    }
  }
  return true;
}

TEST_P(TreeletsOfMesh, BoxesLieWithinThoseAbove)
{
  const TriangleTree tree = treeOf(GetParam().triangles);
  forEachChild(tree, tree.root(), [&](const Treelet& treelet, unsigned lane) {
    if ((treelet.children[lane] & Treelet::kLeaf) == 0)
    {
      const Treelet& child = tree.treelets()[treelet.children[lane]];
      for (unsigned i = 0; i < Treelet::kSize; ++i)
      {
        EXPECT_TRUE(child.children[i] == Treelet::kEmpty || isWithin(child, i, treelet, lane));
      }
    }
  });
}

/// True if a ray of the octant that is in the first box may later be in the second.
bool mayFollow(const Treelet& treelet, unsigned octant, unsigned first, unsigned second)
{
  for (unsigned axis = 0; axis < 3; ++axis)
  {
    const bool isNegative = (octant >> axis & 1) != 0;
    const auto& lower = treelet.bounds[0][axis];
    const auto& upper = treelet.bounds[1][axis];
    // Boxes that touch at a plane count as separated by it, also if one is a float too wide so that
    // the plane hides nothing in it.
    const auto widened = [](float bound) { return std::nextafter(bound, HUGE_VALF); };
    if (isNegative ? widened(lower[second]) >= upper[first]
                   : upper[second] <= widened(lower[first]))
    {
      return false;
    }
  }
  return true;
}

TEST_P(TreeletsOfMesh, NoRayMeetsAFartherChildFirst)
{
  const TriangleTree tree = treeOf(GetParam().triangles);
  const Treelet* last = nullptr;
  forEachChild(tree, tree.root(), [&](const Treelet& treelet, unsigned) {
    if (&treelet == std::exchange(last, &treelet))
    {
      return;
    }
    for (unsigned octant = 0; octant < 8; ++octant)
    {
      std::array<std::uint8_t, Treelet::kSize> order;
      std::copy_n(treelet.farToNear[octant], Treelet::kSize, order.begin());
      for (unsigned far = 0; far < Treelet::kSize; ++far)
      {
        for (unsigned near = far + 1; near < Treelet::kSize; ++near)
        {
          EXPECT_TRUE(treelet.children[order[far]] == Treelet::kEmpty ||
            treelet.children[order[near]] == Treelet::kEmpty ||
            !mayFollow(treelet, octant, order[far], order[near]));
        }
      }
      std::sort(order.begin(), order.end());
      for (unsigned i = 0; i < Treelet::kSize; ++i)
      {
        EXPECT_EQ(order[i], i);
      }
    }
  });
}

INSTANTIATE_TEST_SUITE_P(
  Meshes, TreeletsOfMesh, testing::ValuesIn(test::testMeshes()), test::NameOfMesh());

/// The sum of the areas of all treelets under one at the node that the plan asks for.
double areaOf(const KdTree& tree, const TreeletPlan& plan, std::uint32_t root)
{
  const std::function<double(std::uint32_t, unsigned)> below = [&](std::uint32_t number,
                                                                 unsigned most) -> double {
    const std::uint32_t node = forkAt(tree, number);
    const unsigned onLeft = plan.onLeft(node, most);
    if (onLeft != 0)
    {
      const std::uint32_t child = tree.nodes[node].index();
      return below(child, onLeft) + below(child + 1, most - onLeft);
    }
    return tree.nodes[node].isLeaf() ? 0.0 : areaOf(tree, plan, node);
  };
  return tree.filled[root].halfArea() + below(root, Treelet::kSize);
}

/// The least sum of areas, by trying for each node whether it is the root of a treelet.
class AllPlans
{
public:
  explicit AllPlans(const KdTree& tree)
    : tree_(tree)
  {
    addForks(0);
  }

  std::size_t forks() const { return forks_.size(); }

  double least() const
  {
    double least = kInfinity;
    for (std::uint32_t chosen = 1; chosen < 1u << forks_.size(); chosen += 2)
    {
      least = std::min(least, areaIf(chosen));
    }
    return least;
  }

private:
  void addForks(std::uint32_t number)
  {
    const std::uint32_t node = forkAt(tree_, number);
    if (!tree_.nodes[node].isLeaf())
    {
      forks_.push_back(node);
      addForks(tree_.nodes[node].index());
      addForks(tree_.nodes[node].index() + 1);
    }
  }

  /// Infinite if a treelet has too many children.
  double areaIf(std::uint32_t chosen) const
  {
    double area = 0;
    for (std::size_t i = 0; i < forks_.size(); ++i)
    {
      if ((chosen >> i & 1) != 0)
      {
        area += tree_.filled[forks_[i]].halfArea();
        if (children(forks_[i], chosen, true) > Treelet::kSize)
        {
          return kInfinity;
        }
      }
    }
    return area;
  }

  unsigned children(std::uint32_t number, std::uint32_t chosen, bool isFirst) const
  {
    const std::uint32_t node = forkAt(tree_, number);
    const auto fork = std::find(forks_.begin(), forks_.end(), node) - forks_.begin();
    if (tree_.nodes[node].isLeaf() || (!isFirst && (chosen >> fork & 1) != 0))
    {
      return 1;
    }
    return children(tree_.nodes[node].index(), chosen, false) +
      children(tree_.nodes[node].index() + 1, chosen, false);
  }

  const KdTree& tree_;
  std::vector<std::uint32_t> forks_;
};

TEST(TreeletPlan, HasTheLeastAreaOfAll)
{
  int tried = 0;
  for (unsigned seed = 1; seed <= 12; ++seed)
  {
    const KdTree tree = build(test::randomSoup(18, seed), 1);
    const AllPlans all(tree);
    if (all.forks() >= Treelet::kSize && all.forks() <= 20)
    {
      ++tried;
      const double least = all.least();
      EXPECT_NEAR(areaOf(tree, TreeletPlan(tree), forkAt(tree, 0)), least, 1e-5 * least)
        << "seed " << seed;
    }
  }
  EXPECT_GE(tried, 3);
}

}
}
