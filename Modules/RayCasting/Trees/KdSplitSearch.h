// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_KdSplitSearch_h
#define irradiance_KdSplitSearch_h

#include "Progress/CancelPoint.h"
#include "Trees/KdBins.h"
#include "Trees/KdCost.h"
#include "Trees/KdEvents.h"
#include "Trees/KdItem.h"

#include <array>

namespace irradiance
{

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
  /// `cancelPoint` must outlive the search.
  KdSplitSearch(const KdCost& cost, const CancelPoint& cancelPoint)
    : cost_(cost)
    , pace_(cancelPoint)
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

  KdCost cost_;
  ThrottledCancelPoint pace_;
  std::array<KdBins, 3> bins_;
  std::array<bool, KdBins::kMost> isChosen_; ///< for the bins of the current axis
  KdEvents events_;
};

}

#endif
