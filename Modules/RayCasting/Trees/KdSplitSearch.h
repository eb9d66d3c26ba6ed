// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Trees/KdSplit.h"

namespace irradiance
{

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

  KdSplit best(const KdItems& items, const Box& cell)
  {
    KdSplit best{ config_.leafCost(items.size()) };
    const AxisCosts costs = { KdAxisCost(config_, cell, 0, items.size()),
      KdAxisCost(config_, cell, 1, items.size()), KdAxisCost(config_, cell, 2, items.size()) };
    if (items.size() <= static_cast<std::uint32_t>(config_.blockSize))
    {
      cutOffEmptySpace(items, costs, best);
      return best;
    }
    fillBins(items, cell);
    // Rounding a place to its bin changes the cost by less than this.
    const double slack = 0x1p-20 * best.cost;
    std::array<double, 3> estimates;
    for (int axis = 0; axis < 3; ++axis)
    {
      estimates[axis] = costs[axis].isUseful() ? leastAtEdges(bins_[axis], costs[axis]) : kInfinity;
    }
    // The most promising axis comes first: what it finds saves work on the others.
    std::array<int, 3> order = { 0, 1, 2 };
    std::stable_sort(
      order.begin(), order.end(), [&](int a, int b) { return estimates[a] < estimates[b]; });
    const double promised = estimates[order[0]] + slack;
    for (const int axis : order)
    {
      sweep(items, axis, costs[axis], std::min(best.cost + slack, promised), best);
    }
    for (int axis = 0; axis < 3 && best.cost > promised; ++axis)
    {
      sweep(items, axis, costs[axis], kInfinity, best);
    }
    cutOffSheets(items, cell, costs, best);
    return best;
  }

private:
  /// Looking at a bin costs about as much as looking at two items.
  static int numberOfBins(std::uint32_t items)
  {
    return static_cast<int>(std::clamp(items / 2, 1u, KdBins::kMost));
  }
  static void consider(const KdSplit& split, KdSplit& best)
  {
    if (split.cost < best.cost)
    {
      best = split;
    }
  }
  /// The least cost at an edge of a bin. As a rule some event is as cheap: between two events the
  /// cost is linear, so that one of them is as cheap as any place between. But a plane cannot lie in
  /// the cell's own face, though items may lie flat in it.
  static double leastAtEdges(const KdBins& bins, const KdAxisCost& cost)
  {
    const bool mayLeftBeEmpty = bins.begunBefore(bins.size() - 1) > 0;
    const bool mayRightBeEmpty = bins.endingFrom(1) > 0;
    double least = kInfinity;
    for (int bin = 1; bin < bins.size(); ++bin)
    {
      const std::uint32_t left = bins.begunBefore(bin), right = bins.endingFrom(bin);
      if ((left > 0 || mayLeftBeEmpty) && (right > 0 || mayRightBeEmpty))
      {
        least = std::min(least, cost.ofSplit(bins.edge(bin), left, right));
      }
    }
    return least;
  }
  using AxisCosts = std::array<KdAxisCost, 3>;

  /// A single block of primitives can gain from nothing else.
  void cutOffEmptySpace(const KdItems& items, const AxisCosts& costs, KdSplit& best) const
  {
    const std::uint32_t count = items.size();
    if (count == 0)
    {
      return;
    }
    const KdBounds hull = hullOf(items);
    for (int axis = 0; axis < 3; ++axis)
    {
      const KdAxisCost& cost = costs[axis];
      const float lower = hull.lower[axis], upper = hull.upper[axis];
      if (cost.isUseful() && cost.isInside(lower))
      {
        consider({ cost.ofSplit(lower, 0, count), axis, lower, false, 0, count }, best);
      }
      if (cost.isUseful() && cost.isInside(upper))
      {
        consider({ cost.ofSplit(upper, count, 0), axis, upper, true, count, 0 }, best);
      }
    }
  }
  /// To cut off one wall of a room pays little, as the rest is as large as before, and so the
  /// cheapest plane halves the room. But without all its walls a room is empty. So if the items
  /// include sheets, items that lie flat in a face of their hull, one is cut off if to cut off all is
  /// cheaper.
  void cutOffSheets(const KdItems& items, const Box& cell, const AxisCosts& costs, KdSplit& best)
  {
    const CoplanarFaces sheets(items, pace_);
    if (!sheets.areAny())
    {
      return;
    }
    const double cost = sheets.costOfCuttingAll(config_, cell);
    for (int face = 0; face < CoplanarFaces::kFaces; ++face)
    {
      const std::uint32_t count = sheets.count(face), others = items.size() - count;
      const int axis = face / 2;
      const float plane = sheets.place(face);
      if (count > 0 && costs[axis].isInside(plane))
      {
        const bool isLower = face % 2 == 0;
        consider(
          { cost, axis, plane, isLower, isLower ? count : others, isLower ? others : count }, best);
      }
    }
  }
  void fillBins(const KdItems& items, const Box& cell)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      bins_[axis].reset(cell.lower[axis], cell.upper[axis], numberOfBins(items.size()));
    }
    for (const KdItem& item : items)
    {
      pace_.step();
      for (int axis = 0; axis < 3; ++axis)
      {
        bins_[axis].add(item.lower[axis], item.upper[axis]);
      }
    }
    for (KdBins& bins : bins_)
    {
      bins.accumulate();
    }
  }
  /// Considers all planes across an axis that may be as cheap as `limit`.
  void sweep(const KdItems& items, int axis, const KdAxisCost& cost, double limit, KdSplit& best)
  {
    if (cost.isUseful() && chooseBins(bins_[axis], cost, limit))
    {
      collectEvents(items, axis);
      sweepEvents(axis, cost, best);
    }
  }
  bool chooseBins(const KdBins& bins, const KdAxisCost& cost, double limit)
  {
    bool isAnyChosen = false;
    for (int bin = 0; bin < bins.size(); ++bin)
    {
      const double least = cost.atLeast(
        bins.edge(bin), bins.begunBefore(bin), bins.edge(bin + 1), bins.endingFrom(bin + 1));
      isChosen_[bin] = least <= limit;
      isAnyChosen = isAnyChosen || isChosen_[bin];
    }
    return isAnyChosen;
  }
  void collectEvents(const KdItems& items, int axis)
  {
    const KdBins& bins = bins_[axis];
    events_.clear();
    for (const KdItem& item : items)
    {
      pace_.step();
      const float lower = item.lower[axis], upper = item.upper[axis];
      events_.add(lower, upper, isChosen_[bins.of(lower)], isChosen_[bins.of(upper)]);
    }
    events_.sort();
  }
  /// Sweeps a plane over the chosen bins and counts what lies on either side.
  void sweepEvents(int axis, const KdAxisCost& cost, KdSplit& best)
  {
    const KdBins& bins = bins_[axis];
    int bin = -1;
    std::uint32_t left = 0, right = 0;
    KdEvents::Step step;
    while (events_.next(step))
    {
      if (bins.of(step.x) != bin)
      {
        bin = bins.of(step.x);
        left = bins.begunBefore(bin);
        right = bins.endingFrom(bin);
      }
      right -= step.ending + step.lying;
      if (cost.isInside(step.x))
      {
        const std::uint32_t more = left + step.lying;
        consider({ cost.ofSplit(step.x, more, right), axis, step.x, true, more, right }, best);
      }
      if (cost.isInside(step.x) && step.lying > 0)
      {
        const std::uint32_t more = right + step.lying;
        consider({ cost.ofSplit(step.x, left, more), axis, step.x, false, left, more }, best);
      }
      left += step.beginning + step.lying;
    }
  }

  const KdTreeBuilder& config_;
  ThrottledCancelPoint pace_;
  std::array<KdBins, 3> bins_;
  std::array<bool, KdBins::kMost> isChosen_; ///< for the bins of the current axis
  KdEvents events_;
};

}
