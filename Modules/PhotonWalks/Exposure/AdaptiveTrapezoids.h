// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Exposure/IntegrationTimes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace irradiance
{

/**
 * The trapezoidal rule over pairs of intervals that are halved, the worst pair first, until their
 * error, as estimated, is small enough. Documentation/Theory.md, 5.6.
 *
 * The first times are visited in order. Then the two intervals of the worst pair are visited in
 * their middles, which makes a pair of each. All decisions follow from the samples, so the times do
 * too.
 *
 * Only the samples of pairs that may yet be halved are held. A settled pair is added up, and its
 * sums wait for the sums of its neighbour: of the other half of what was halved, or, from a pair of
 * the first times upwards, of the other half of a range of such pairs. So the order of additions
 * does not depend on what was settled when.
 *
 * Sample: what is known at one time, with a member `time`. Sums: of samples, in the order of time,
 * with `add(sample, weight)`, `close()` when all are added, and `append(sums over later times)`.
 */
template <class Sample, class Sums>
class AdaptiveTrapezoids
{
public:
  /// `firstTimes`: in order, an odd number from 3 on. `tolerance`: relative to the sums of a block.
  AdaptiveTrapezoids(std::vector<double> firstTimes, double tolerance, std::size_t mostIntervals)
    : firstTimes_(std::move(firstTimes))
    , halving_(firstTimes_.back() - firstTimes_.front(), tolerance, mostIntervals)
  {
    makeSpans(std::make_shared<Span>(), (firstTimes_.size() - 1) / 2);
  }

  bool isDone() const { return sums_ != nullptr; }
  /// The times that are needed next, in order, as far as they are known: 1 to `most`; not if done.
  std::vector<double> nextTimes(std::size_t most) const
  {
    std::vector<double> next;
    for (std::size_t i = times_.size(); i < firstTimes_.size() && next.size() < most; ++i)
    {
      next.push_back(firstTimes_[i]);
    }
    for (std::size_t i = 0; i < tasks_.size() && next.size() < most; ++i)
    {
      next.push_back(middleOf(tasks_[i].start->time, tasks_[i].end->time));
    }
    return next;
  }
  /// Takes the sample of the next time. `measure(three samples)`: what they bring to each block, see
  /// IntervalMeasure.
  template <class Measure>
  void take(Sample sample, const Measure& measure)
  {
    const auto node = std::make_shared<const Sample>(std::move(sample));
    const bool isFirst = times_.size() < firstTimes_.size();
    times_.push_back(node->time);
    const double known =
      static_cast<double>(times_.size()) / static_cast<double>(firstTimes_.size());
    progress_ = std::max(progress_, kFirstShare * std::min(1.0, known));
    if (!isFirst)
    {
      tasks_.front().middle = node;
      addPair(tasks_.front(), measure);
      tasks_.pop_front();
    }
    else
    {
      recent_.push_back(node);
      if (recent_.size() == 3)
      {
        addPair(
          { recent_[0], recent_[1], recent_[2], firstSpans_[times_.size() / 2 - 1] }, measure);
        recent_ = { node };
      }
    }
    if (times_.size() == firstTimes_.size())
    {
      firstExcess_ = halving_.excess();
      recent_.clear();
    }
    for (const std::size_t id : halving_.takeSettled())
    {
      settle(id);
    }
    if (times_.size() >= firstTimes_.size() && tasks_.empty())
    {
      halveWorst();
    }
  }
  /// From 0 to 1.
  double progress() const { return progress_; }
  const TimeHalving& halving() const { return halving_; }

  /// When it is done: all times, in order, and the sums over them, which are given away.
  const std::vector<double>& times() const { return times_; }
  Sums takeSums() { return std::move(*sums_); }

private:
  /// The part of the progress that the first times make.
  static constexpr double kFirstShare = 0.5;

  using Node = std::shared_ptr<const Sample>;
  /// A span of time, whose sums go to the span of which it is the first or the second half.
  struct Span
  {
    std::shared_ptr<Span> whole; ///< null: it is all
    bool isSecond = false;
    std::unique_ptr<Sums> half; ///< of the half whose sums came first
  };
  /// Two intervals; or one, until its middle is visited.
  struct Pair
  {
    Node start, middle, end;
    std::shared_ptr<Span> span;
  };

  static std::shared_ptr<Span> halfOf(const std::shared_ptr<Span>& whole, bool isSecond)
  {
    return std::make_shared<Span>(Span{ whole, isSecond, nullptr });
  }
  void makeSpans(const std::shared_ptr<Span>& span, std::size_t count)
  {
    if (count == 1)
    {
      firstSpans_.push_back(span);
      return;
    }
    makeSpans(halfOf(span, false), count / 2);
    makeSpans(halfOf(span, true), count - count / 2);
  }
  template <class Measure>
  void addPair(const Pair& pair, const Measure& measure)
  {
    const std::size_t id = nextId_++;
    halving_.add({ id, pair.start->time, pair.middle->time, pair.end->time,
      measure(
        std::array<const Sample*, 3>{ pair.start.get(), pair.middle.get(), pair.end.get() }) });
    open_.emplace(id, pair);
  }
  void settle(std::size_t id)
  {
    const Pair pair = open_.at(id);
    open_.erase(id);
    const double start = pair.start->time, middle = pair.middle->time, end = pair.end->time;
    auto sums = std::make_unique<Sums>();
    sums->add(*pair.start, trapezoidWeight(start, middle));
    sums->add(*pair.middle, trapezoidWeight(start, end));
    sums->add(*pair.end, trapezoidWeight(middle, end));
    sums->close();
    deliver(pair.span, std::move(sums));
  }
  void deliver(std::shared_ptr<Span> span, std::unique_ptr<Sums> sums)
  {
    for (; span->whole; span = span->whole)
    {
      std::unique_ptr<Sums>& other = span->whole->half;
      if (!other)
      {
        other = std::move(sums);
        return;
      }
      if (span->isSecond)
      {
        std::swap(sums, other);
      }
      sums->append(std::move(*other));
    }
    sums_ = std::move(sums);
  }
  /// Asks for the halves of the worst pair, or ends.
  void halveWorst()
  {
    // It falls about like a geometric sequence, until it is 1.
    const double left = std::log(halving_.excess()) / std::log(firstExcess_);
    const auto worst = halving_.takeWorst();
    if (!worst)
    {
      while (!open_.empty())
      {
        settle(open_.begin()->first);
      }
      std::sort(times_.begin(), times_.end());
      progress_ = 1;
      return;
    }
    progress_ = std::max(progress_, 1 - (1 - kFirstShare) * std::clamp(left, 0.0, 1.0));
    const Pair pair = open_.at(*worst);
    open_.erase(*worst);
    tasks_.push_back({ pair.start, nullptr, pair.middle, halfOf(pair.span, false) });
    tasks_.push_back({ pair.middle, nullptr, pair.end, halfOf(pair.span, true) });
  }

  std::vector<double> firstTimes_;
  TimeHalving halving_;
  std::vector<double> times_;                     ///< in the order of visits, until all is done
  std::vector<std::shared_ptr<Span>> firstSpans_; ///< of pairs of first intervals
  std::vector<Node> recent_; ///< at the first times, of the pair that is not complete
  std::map<std::size_t, Pair> open_;
  std::size_t nextId_ = 0;
  std::deque<Pair> tasks_; ///< intervals whose middles are to be visited
  double firstExcess_ = 0; ///< TimeHalving::excess() when all first times are known
  double progress_ = 0;
  std::unique_ptr<Sums> sums_; ///< over all; null until it is done
};

}
