// SPDX-License-Identifier: BSD-3-Clause
#include "Gathering/LampTree.h"

#include <algorithm>
#include <numeric>

namespace irradiance
{

namespace
{

/// Lamps whose mean normal is longer than this have one normal together.
constexpr double kAlike = 0.95;

Box boundsOf(const LampPiece& piece)
{
  Box box;
  if (piece.normal.isZero(0))
  {
    box.add(piece.center);
    return box;
  }
  for (const Vector3& corner : { piece.triangle.a, piece.triangle.b, piece.triangle.c })
  {
    box.add(corner);
  }
  return box;
}

}

LampTree::LampTree(const std::vector<LampPiece>& pieces)
  : order_(pieces.size())
{
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.push_back({ {}, 0, static_cast<std::uint32_t>(pieces.size()), 0 });
  for (std::uint32_t number = 0; number < nodes_.size() && !pieces.empty(); ++number)
  {
    split(number, pieces);
  }
  fluxBefore_.push_back(0);
  places_.resize(pieces.size());
  for (const std::uint32_t piece : order_)
  {
    places_[piece] = static_cast<std::uint32_t>(fluxBefore_.size() - 1);
    fluxBefore_.push_back(fluxBefore_.back() + pieces[piece].flux);
  }
}

/// At the median along the longest edge of the bounds.
void LampTree::split(std::uint32_t number, const std::vector<LampPiece>& pieces)
{
  const std::uint32_t first = nodes_[number].first, end = nodes_[number].end;
  if (end - first == 1)
  {
    nodes_[number].lamp = pieces[order_[first]];
    return;
  }
  Box bounds;
  double flux = 0;
  Vector3 normals = Vector3::Zero();
  for (std::uint32_t place = first; place < end; ++place)
  {
    bounds.add(boundsOf(pieces[order_[place]]));
    flux += pieces[order_[place]].flux;
    normals += pieces[order_[place]].normal;
  }
  Eigen::Index axis = 0;
  bounds.extent().maxCoeff(&axis);
  const std::uint32_t middle = first + (end - first) / 2;
  const auto at = [&](std::uint32_t place) { return order_.begin() + place; };
  std::nth_element(at(first), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
    const double left = pieces[a].center[axis], right = pieces[b].center[axis];
    return left < right || (left == right && a < b);
  });
  LampPiece& lamp = nodes_[number].lamp;
  lamp.flux = flux;
  lamp.normal = normals.norm() > kAlike * (end - first) ? normals.normalized() : Vector3::Zero();
  lamp.center = bounds.center();
  lamp.radius = bounds.extent().norm() / 2;
  nodes_[number].children = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({ {}, first, middle, 0 });
  nodes_.push_back({ {}, middle, end, 0 });
}

LampTree::Share LampTree::choose(const Node& node, double part) const
{
  if (node.isLeaf())
  {
    return { order_[node.first], 1, part };
  }
  const auto at = [&](std::uint32_t place) { return fluxBefore_.begin() + place; };
  const double before = *at(node.first), flux = *at(node.end) - before;
  const double place = before + part * flux;
  const auto found = std::upper_bound(at(node.first + 1), at(node.end), place) - 1;
  const double own = *(found + 1) - *found;
  return { order_[static_cast<std::size_t>(found - fluxBefore_.begin())], own / flux,
    std::clamp((place - *found) / own, 0.0, 1 - 0x1p-53) };
}

double LampTree::probabilityOf(const Node& node, std::uint32_t piece) const
{
  const std::uint32_t place = places_[piece];
  return node.first <= place && place < node.end ? (fluxBefore_[place + 1] - fluxBefore_[place]) /
      (fluxBefore_[node.end] - fluxBefore_[node.first])
                                                 : 0;
}

}
