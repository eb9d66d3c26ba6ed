// SPDX-License-Identifier: BSD-3-Clause
#include "Trees/SurfaceTree.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace irradiance
{

class SurfaceTree::Builder
{
public:
  Builder(SurfaceTree& tree, const TriangleMesh& mesh, const CancelPoint& cancelPoint)
    : tree_(tree)
    , pace_(cancelPoint)
  {
    for (std::uint32_t i = 0; i < mesh.size(); ++i)
    {
      const UnitFrame& frame = tree.frame_;
      const Triangle unit{ frame(mesh[i].a), frame(mesh[i].b), frame(mesh[i].c) };
      const Vector3 twice = unit.areaVector();
      const double area = twice.norm();
      if (area > 0)
      {
        items_.push_back({ unit, twice / area, 0.5 * area, i });
      }
      pace_.step();
    }
    if (!items_.empty())
    {
      build(0, items_.size());
    }
    for (const Item& item : items_)
    {
      tree.order_.push_back(item.triangle);
    }
  }

private:
  static constexpr std::size_t kFew = 4;

  struct Item
  {
    Triangle unit;
    Vector3 normal;
    double area;
    std::uint32_t triangle;

    Vector3 corners() const { return unit.a + unit.b + unit.c; }
  };

  void build(std::size_t begin, std::size_t end)
  {
    const std::size_t number = tree_.nodes_.size();
    tree_.nodes_.push_back(nodeOf(begin, end));
    pace_.step(end - begin);
    if (end - begin > kFew)
    {
      const std::size_t middle = cut(begin, end);
      build(begin, middle);
      tree_.nodes_[number].right = static_cast<std::uint32_t>(tree_.nodes_.size());
      build(middle, end);
    }
  }

  std::size_t cut(std::size_t begin, std::size_t end)
  {
    Box middles;
    for (std::size_t i = begin; i < end; ++i)
    {
      middles.add(items_[i].corners());
    }
    Eigen::Index axis;
    middles.extent().maxCoeff(&axis);
    const auto at = [&](std::size_t i) { return items_.begin() + static_cast<std::ptrdiff_t>(i); };
    const std::size_t middle = (begin + end) / 2;
    std::nth_element(at(begin), at(middle), at(end), [axis](const Item& a, const Item& b) {
      return std::make_pair(a.corners()[axis], a.triangle) <
        std::make_pair(b.corners()[axis], b.triangle);
    });
    return middle;
  }

  SurfaceNode nodeOf(std::size_t begin, std::size_t end) const
  {
    SurfaceNode node{ {}, 0, Vector3::Zero(), 0, 1, 0, 0, static_cast<std::uint32_t>(begin),
      static_cast<std::uint32_t>(end), 0, 0 };
    Box box;
    for (std::size_t i = begin; i < end; ++i)
    {
      const Item& item = items_[i];
      box.add(item.unit.bounds());
      node.area += item.area;
      node.axis += item.area * item.normal;
      node.solidSides |= SurfaceNode::maskOf(tree_.solidSides_[item.triangle]);
    }
    const double length = node.axis.norm();
    node.axis = length > 0 ? Vector3(node.axis / length) : Vector3::UnitZ();
    node.center = box.center();
    addShape(node);
    return node;
  }

  void addShape(SurfaceNode& node) const
  {
    double lowest = kInfinity, highest = -kInfinity;
    for (std::size_t i = node.begin; i < node.end; ++i)
    {
      const Triangle& unit = items_[i].unit;
      for (const Vector3* corner : { &unit.a, &unit.b, &unit.c })
      {
        const double height = node.axis.dot(*corner - node.center);
        lowest = std::min(lowest, height);
        highest = std::max(highest, height);
      }
      node.cosine = std::min(node.cosine, node.axis.dot(items_[i].normal));
      // The cosine hardly changes with a small angle.
      node.sine = std::max(node.sine, node.axis.cross(items_[i].normal).norm());
    }
    constexpr double kRounding = 0x1p-48;
    node.thickness = 0.5 * (highest - lowest) + kRounding;
    node.center += 0.5 * (lowest + highest) * node.axis;
    double squared = 0;
    for (std::size_t i = node.begin; i < node.end; ++i)
    {
      const Triangle& unit = items_[i].unit;
      for (const Vector3* corner : { &unit.a, &unit.b, &unit.c })
      {
        squared = std::max(squared, (*corner - node.center).squaredNorm());
      }
    }
    node.radius = std::sqrt(squared) + kRounding;
  }

  SurfaceTree& tree_;
  ThrottledCancelPoint pace_;
  std::vector<Item> items_;
};

SurfaceTree::SurfaceTree(
  const TriangleMesh& mesh, std::vector<SolidSide> solidSides, const CancelPoint& cancelPoint)
  : frame_(mesh.bounds())
  , solidSides_(std::move(solidSides))
{
  Builder(*this, mesh, cancelPoint);
}

}
