// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Trees/KdBounds.h"
#include "Trees/KdTreeBuilder.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace irradiance
{

/// Counts how many items begin and end in each of the equal parts of an interval.
class KdBins
{
public:
  static constexpr std::uint32_t kMost = 128;

  void reset(double lower, double upper, int size)
  {
    size_ = size;
    last_ = static_cast<float>(size - 1);
    lower_ = roundDown(lower);
    width_ = (upper - lower_) / size;
    // The scale stays finite, because infinity times zero is NaN.
    constexpr double kMostScale = std::numeric_limits<float>::max();
    scale_ = width_ > 0 ? static_cast<float>(std::min(1 / width_, kMostScale)) : 0.0f;
    std::fill_n(begins_.begin(), size + 1, 0);
    std::fill_n(ends_.begin(), size + 1, 0);
  }

  int size() const { return size_; }
  double edge(int bin) const { return lower_ + bin * width_; }
  /// The bin of x >= `lower`; monotonic in x. Rounding may choose the neighbour of the right bin if
  /// x is within 2^-22 of the interval's length of their common edge.
  int of(float x) const { return static_cast<int>(std::min((x - lower_) * scale_, last_)); }

  void add(float lower, float upper)
  {
    ++begins_[of(lower) + 1];
    ++ends_[of(upper)];
  }
  /// Ends the counting. Call it before the sums below.
  void accumulate()
  {
    for (int bin = 0; bin < size_; ++bin)
    {
      begins_[bin + 1] += begins_[bin];
      ends_[size_ - 1 - bin] += ends_[size_ - bin];
    }
  }
  /// Number of items that begin in the bins before this one.
  std::uint32_t begunBefore(int bin) const { return begins_[bin]; }
  /// Number of items that end in this bin or after it.
  std::uint32_t endingFrom(int bin) const { return ends_[bin]; }

private:
  int size_ = 1;
  float last_ = 0, lower_ = 0, scale_ = 0;
  double width_ = 0;
  std::array<std::uint32_t, kMost + 1> begins_, ends_;
};

/// Where items begin, end, or lie flat on one axis, in ascending order. All places are finite.
class KdEvents
{
public:
  /// All events at one place.
  struct Step
  {
    float x;
    std::uint32_t ending, lying, beginning;
  };

  void clear()
  {
    for (std::vector<float>& places : places_)
    {
      places.clear();
    }
  }
  /// Adds the requested events of an item. A flat item has only one event.
  void add(float lower, float upper, bool takesLower, bool takesUpper)
  {
    if (takesLower)
    {
      places_[lower == upper ? kFlat : kBegin].push_back(lower);
    }
    if (takesUpper && lower != upper)
    {
      places_[kEnd].push_back(upper);
    }
  }
  void sort()
  {
    for (std::size_t kind = 0; kind < places_.size(); ++kind)
    {
      std::sort(places_[kind].begin(), places_[kind].end());
      places_[kind].push_back(HUGE_VALF);
      next_[kind] = places_[kind].data();
    }
  }
  /// After sort(): goes to the next place; false if there is none.
  bool next(Step& step)
  {
    step.x = std::min({ *next_[kBegin], *next_[kEnd], *next_[kFlat] });
    if (step.x == HUGE_VALF)
    {
      return false;
    }
    const auto pass = [&](std::size_t kind) {
      const float* const first = next_[kind];
      while (*next_[kind] == step.x)
      {
        ++next_[kind];
      }
      return static_cast<std::uint32_t>(next_[kind] - first);
    };
    step.ending = pass(kEnd);
    step.lying = pass(kFlat);
    step.beginning = pass(kBegin);
    return true;
  }

private:
  static constexpr std::size_t kBegin = 0, kEnd = 1, kFlat = 2;

  std::array<std::vector<float>, 3> places_; ///< by kind
  std::array<const float*, 3> next_{};
};

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

/// The items that lie flat in the faces of the hull of all items: the walls of a room, the sides of
/// a box. Face 2 i is the lower one on axis i, face 2 i + 1 the upper one.
class CoplanarFaces
{
public:
  static constexpr int kFaces = 6;

  CoplanarFaces(const KdItems& items, ThrottledCancelPoint& pace)
    : hull_(hullOf(items))
  {
    for (const KdItem& item : items)
    {
      pace.step();
      int first = kFaces;
      for (int face = kFaces; face-- > 0;)
      {
        if (item.lower[face / 2] == item.upper[face / 2] && item.lower[face / 2] == place(face))
        {
          ++counts_[face];
          first = face;
        }
      }
      parts_[first].bounds.add(item);
      ++parts_[first].count;
    }
  }

  /// False if there are none, or if one of them is all.
  bool areAny() const
  {
    return std::count_if(
             parts_.begin(), parts_.end(), [](const Part& part) { return part.count > 0; }) > 1;
  }
  /// The number of items in a face, 0 if each of them is in a face before this one. An item in an
  /// edge of the hull is in two faces.
  std::uint32_t count(int face) const { return parts_[face].count > 0 ? counts_[face] : 0; }
  /// Of the face on its axis.
  float place(int face) const
  {
    return face % 2 == 0 ? hull_.lower[face / 2] : hull_.upper[face / 2];
  }
  /// The expected cost of a ray that enters the cell if a plane cuts off each sheet.
  double costOfCuttingAll(const KdTreeBuilder& config, const Box& cell) const
  {
    const Vector3 extent = cell.extent();
    const double area = extent[0] * extent[1] + extent[1] * extent[2] + extent[2] * extent[0];
    const auto costOf = [&](const Part& part) {
      return part.count == 0 ? 0 : part.bounds.halfArea() / area * config.leafCost(part.count);
    };
    double sum = costOf(parts_[kFaces]);
    for (int face = 0; face < kFaces; ++face)
    {
      sum += parts_[face].count > 0 ? config.traversalCost + costOf(parts_[face]) : 0;
    }
    return sum;
  }

private:
  struct Part
  {
    KdBounds bounds;
    std::uint32_t count = 0;
  };

  KdBounds hull_;
  std::array<std::uint32_t, kFaces> counts_ = {};
  /// The sheets, each item in its first one, and last what is in none.
  std::array<Part, kFaces + 1> parts_;
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

}
