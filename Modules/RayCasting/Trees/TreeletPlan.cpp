// SPDX-License-Identifier: BSD-3-Clause
#include "Trees/TreeletPlan.h"

namespace irradiance
{

std::uint32_t forkAt(const KdTree& tree, std::uint32_t node)
{
  while (!tree.nodes[node].isLeaf())
  {
    const std::uint32_t left = tree.nodes[node].index();
    const bool isLeftEmpty = tree.filled[left].isEmpty();
    if (!isLeftEmpty && !tree.filled[left + 1].isEmpty())
    {
      break;
    }
    node = left + (isLeftEmpty ? 1 : 0);
  }
  return node;
}

TreeletPlan::TreeletPlan(const KdTree& tree, const CancelPoint& cancelPoint)
  : tree_(tree)
  , pace_(cancelPoint)
  , onLeft_(tree.nodes.size())
{
  plan(0);
}

TreeletPlan::Areas TreeletPlan::plan(std::uint32_t node)
{
  pace_.step(kSize);
  node = forkAt(tree_, node);
  if (tree_.nodes[node].isLeaf())
  {
    return {};
  }
  Areas areas = part(node);
  const float asTreelet = areas[kSize - 1] + tree_.filled[node].halfArea();
  for (unsigned most = 1; most < kSize; ++most)
  {
    if (most == 1 || asTreelet <= areas[most - 1])
    {
      areas[most - 1] = asTreelet;
      onLeft_[node][most - 1] = 0;
    }
  }
  return areas;
}

TreeletPlan::Areas TreeletPlan::part(std::uint32_t node)
{
  const std::uint32_t child = tree_.nodes[node].index();
  const Areas left = plan(child), right = plan(child + 1);
  Areas areas{};
  for (unsigned most = 2; most <= kSize; ++most)
  {
    unsigned best = 1;
    const auto area = [&](unsigned onLeft) { return left[onLeft - 1] + right[most - onLeft - 1]; };
    for (unsigned onLeft = 2; onLeft < most; ++onLeft)
    {
      best = area(onLeft) < area(best) ? onLeft : best;
    }
    areas[most - 1] = area(best);
    onLeft_[node][most - 1] = static_cast<std::uint8_t>(best);
  }
  return areas;
}

}
