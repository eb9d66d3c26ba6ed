// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_KdCost_h
#define irradiance_KdCost_h

#include "Geometry/Vector.h"

#include <algorithm>
#include <cstdint>

namespace irradiance
{

/// The expected cost of a ray that enters a node, in any unit.
struct KdCost
{
  double traversal;   ///< of an inner node
  double block;       ///< of testing up to blockSize primitives
  double emptyFactor; ///< of a split that cuts off empty space
  double parting;     ///< see KdTreeBuilder
  std::uint32_t blockSize;

  double leaf(std::uint32_t primitives) const
  {
    const std::uint32_t blocks = (primitives + blockSize - 1) / blockSize;
    return block * static_cast<double>(blocks);
  }
};

/// The surface-area heuristic for planes across one axis of a cell with `primitives`.
class KdAxisCost
{
public:
  KdAxisCost(const KdCost& cost, const Box& cell, int axis, std::uint32_t primitives)
    : cost_(cost)
    , primitives_(primitives)
    , lower_(cell.lower[axis])
    , upper_(cell.upper[axis])
  {
    const Vector3 extent = cell.extent();
    const double u = extent[(axis + 1) % 3], v = extent[(axis + 2) % 3];
    const double area = u * v + (u + v) * extent[axis];
    isUseful_ = extent[axis] > 0 && area > 0 && area < kInfinity;
    cap_ = u * v / area;
    rim_ = (u + v) / area;
  }

  /// False if no plane across this axis can split the cell.
  bool isUseful() const { return isUseful_; }
  bool isInside(float plane) const { return plane > lower_ && plane < upper_; }

  double ofSplit(double plane, std::uint32_t left, std::uint32_t right) const
  {
    return atLeast(plane, left, plane, right);
  }
  /// A lower bound for splits with at least these numbers of primitives in cells at least as large.
  double atLeast(double leftUpTo, std::uint32_t left, double rightFrom, std::uint32_t right) const
  {
    const double cost = cost_.traversal + (cap_ + rim_ * (leftUpTo - lower_)) * cost_.leaf(left) +
      (cap_ + rim_ * (upper_ - rightFrom)) * cost_.leaf(right);
    if (left == 0 || right == 0)
    {
      return cost_.emptyFactor * cost;
    }
    const double parted = std::max(0.0, static_cast<double>(left) + right - primitives_);
    return cost * (1 + cost_.parting * parted / primitives_);
  }

private:
  KdCost cost_;
  double primitives_;
  double lower_, upper_;
  bool isUseful_;
  // areas over the cell's: of one end, and of the sides for each unit of length.
  double cap_, rim_;
};

}

#endif
