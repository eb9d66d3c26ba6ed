// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_KdSplitSearch_h
#define irradiance_KdSplitSearch_h

#include "Trees/KdBins.h"
#include "Trees/KdTreeBuilder.h"

#include <algorithm>
#include <array>

namespace irradiance
{

/// The surface-area heuristic for planes across one axis of a cell with `primitives`.
class KdAxisCost
{
public:
  KdAxisCost(const KdTreeBuilder& config, const Box& cell, int axis, std::uint32_t primitives)
    : config_(config)
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
    const double cost = config_.traversalCost +
      (cap_ + rim_ * (leftUpTo - lower_)) * config_.leafCost(left) +
      (cap_ + rim_ * (upper_ - rightFrom)) * config_.leafCost(right);
    if (left == 0 || right == 0)
    {
      return config_.emptyFactor * cost;
    }
    const double parted = std::max(0.0, static_cast<double>(left) + right - primitives_);
    return cost * (1 + config_.partingCost * parted / primitives_);
  }

private:
  const KdTreeBuilder& config_;
  double primitives_;
  double lower_, upper_;
  bool isUseful_;
  // areas over the cell's: of one end, and of the sides for each unit of length.
  double cap_, rim_;
};

struct KdSplit
{
  double cost;
  int axis = -1; ///< negative: no split is cheaper than a leaf
  float plane = 0;
  bool flatGoLeft = true;            ///< side of the items that lie in the plane
  std::uint32_t left = 0, right = 0; ///< numbers of items, judged by their bounds

  bool parts(const KdItem& item) const
  {
    return item.lower[axis] < plane && item.upper[axis] > plane;
  }
  /// The side of an item that is not split.
  bool isLeft(const KdItem& item) const
  {
    return flatGoLeft ? item.upper[axis] <= plane : item.lower[axis] < plane;
  }
};

/**
 * Finds the cheapest of all planes at which an item begins or ends. First, bins give lower bounds
 * of the cost. Then only events in bins that may hold the cheapest plane are sorted and swept. So
 * a full sweep would give the same answer; this usually takes linear time.
 */
class KdSplitSearch
{
public:
  /// `config` must outlive the search.
  explicit KdSplitSearch(const KdTreeBuilder& config)
    : config_(config)
    , pace_(config.cancelPoint)
  {
  }

  KdSplit best(const KdItems& items, const Box& cell);

private:
  using AxisCosts = std::array<KdAxisCost, 3>;

  void cutOffEmptySpace(const KdItems& items, const AxisCosts& costs, KdSplit& best) const;
  void cutOffSheets(const KdItems& items, const Box& cell, const AxisCosts& costs, KdSplit& best);
  void fillBins(const KdItems& items, const Box& cell);
  void sweep(const KdItems& items, int axis, const KdAxisCost& cost, double limit, KdSplit& best);
  bool chooseBins(const KdBins& bins, const KdAxisCost& cost, double limit);
  void collectEvents(const KdItems& items, int axis);
  void sweepEvents(int axis, const KdAxisCost& cost, KdSplit& best);

  const KdTreeBuilder& config_;
  ThrottledCancelPoint pace_;
  std::array<KdBins, 3> bins_;
  std::array<bool, KdBins::kMost> isChosen_; ///< for the bins of the current axis
  KdEvents events_;
};

}

#endif
