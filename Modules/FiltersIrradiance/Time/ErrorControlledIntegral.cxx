// SPDX-License-Identifier: BSD-3-Clause
#include "Time/ErrorControlledIntegral.h"

#include "Data/LeafData.h"
#include "Progress/InputError.h"

#include <algorithm>
#include <cmath>

namespace irradiance
{

namespace
{

constexpr double kFirstShare = 0.5; ///< of the progress: that of the first times

/// The largest ratio of any block.
template <typename Part>
double worstRatio(const std::vector<IntervalMeasure>& blocks, Part part)
{
  double worst = 0;
  for (const IntervalMeasure& block : blocks)
  {
    worst = part(block) > 0 ? std::max(worst, part(block) / block.energy) : worst;
  }
  return worst;
}

}

ErrorControlledIntegral::ErrorControlledIntegral(
  std::vector<double> firstTimes, double tolerance, int mostIntervals)
  : firstTimes_(std::move(firstTimes))
  , tolerance_(tolerance)
  , mostIntervals_(mostIntervals)
  , halving_({ firstTimes_.back() - firstTimes_.front(), tolerance,
      static_cast<std::size_t>(mostIntervals) })
{
  makePlaces({}, (firstTimes_.size() - 1) / 2);
}

void ErrorControlledIntegral::makePlaces(const Place& place, std::size_t count)
{
  if (count == 1)
  {
    firstPlaces_.push_back(place);
    return;
  }
  const auto merge = std::make_shared<Merge>(Merge{ place, nullptr });
  makePlaces({ merge, false }, count / 2);
  makePlaces({ merge, true }, count - count / 2);
}

double ErrorControlledIntegral::nextTime() const
{
  return times_.size() < firstTimes_.size()
    ? firstTimes_[times_.size()]
    : middleOf(tasks_.front().start->time(), tasks_.front().end->time());
}

void ErrorControlledIntegral::take(vtkDataObject* data)
{
  const double time = nextTime();
  const auto snapshot = snapshotOf(data);
  checks_.add(snapshot, time, 0);
  checks_.close();
  const auto node = std::make_shared<const ExposureNode>(time, snapshot, blocks_);
  const bool isFirst = times_.size() < firstTimes_.size();
  times_.push_back(time);
  const double known = static_cast<double>(times_.size()) / static_cast<double>(firstTimes_.size());
  progress_ = std::max(progress_, kFirstShare * std::min(1.0, known));
  if (!isFirst)
  {
    addPair({ tasks_.front().start, node, tasks_.front().end, tasks_.front().place });
    tasks_.pop_front();
  }
  else
  {
    recent_.push_back(node);
    if (recent_.size() == 3)
    {
      addPair({ recent_[0], recent_[1], recent_[2], firstPlaces_[times_.size() / 2 - 1] });
      recent_ = { node };
    }
  }
  if (times_.size() == firstTimes_.size())
  {
    last_ = snapshot;
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

void ErrorControlledIntegral::addPair(const Pair& pair)
{
  const std::size_t id = nextId_++;
  halving_.add({ id, pair.start->time(), pair.middle->time(), pair.end->time(),
    ExposureNode::measure({ pair.start.get(), pair.middle.get(), pair.end.get() }, blocks_) });
  open_.emplace(id, pair);
}

void ErrorControlledIntegral::halveWorst()
{
  // It falls about like a geometric sequence, until it is 1.
  const double left = std::log(halving_.excess()) / std::log(firstExcess_);
  const auto worst = halving_.takeWorst();
  if (!worst)
  {
    finish();
    return;
  }
  progress_ = std::max(progress_, 1 - (1 - kFirstShare) * std::clamp(left, 0.0, 1.0));
  const Pair pair = open_.at(*worst);
  open_.erase(*worst);
  const auto merge = std::make_shared<Merge>(Merge{ pair.place, nullptr });
  tasks_.push_back({ pair.start, pair.middle, { merge, false } });
  tasks_.push_back({ pair.middle, pair.end, { merge, true } });
}

void ErrorControlledIntegral::settle(std::size_t id)
{
  const Pair pair = open_.at(id);
  open_.erase(id);
  const double start = pair.start->time(), middle = pair.middle->time(), end = pair.end->time();
  auto sums = std::make_unique<ExposureSums>();
  sums->add(pair.start->data(), start, trapezoidWeight(start, middle));
  sums->add(pair.middle->data(), middle, trapezoidWeight(start, end));
  sums->add(pair.end->data(), end, trapezoidWeight(middle, end));
  sums->close();
  deliver(pair.place, std::move(sums));
}

void ErrorControlledIntegral::deliver(Place place, std::unique_ptr<ExposureSums> sums)
{
  while (place.whole)
  {
    Merge& merge = *place.whole;
    if (!merge.other)
    {
      merge.other = std::move(sums);
      return;
    }
    if (place.isSecond)
    {
      std::swap(sums, merge.other);
    }
    sums->append(std::move(*merge.other));
    place = Place(merge.place);
  }
  sums_ = std::move(*sums);
}

void ErrorControlledIntegral::finish()
{
  while (!open_.empty())
  {
    settle(open_.begin()->first);
  }
  std::sort(times_.begin(), times_.end());
  progress_ = 1;
  isDone_ = true;
}

double ErrorControlledIntegral::relativeError() const
{
  return worstRatio(halving_.totals(), [](const IntervalMeasure& block) { return block.error; });
}

double ErrorControlledIntegral::relativeNoise() const
{
  return worstRatio(halving_.totals(), [](const IntervalMeasure& block) { return block.noise; });
}

std::string ErrorControlledIntegral::shortfall() const
{
  if (relativeError() <= tolerance_)
  {
    return "";
  }
  const std::vector<IntervalMeasure> totals = halving_.totals();
  std::string blocks;
  for (std::size_t i = 0; i < totals.size(); ++i)
  {
    if (totals[i].error > tolerance_ * totals[i].energy)
    {
      blocks += (blocks.empty() ? "" : ", ") + blocks_[i].name + ": " +
        text(totals[i].error / totals[i].energy);
    }
  }
  return "RelativeTolerance " + text(tolerance_) +
    " is not reached with MaximumNumberOfTimeSteps " + std::to_string(mostIntervals_) +
    ". Estimated errors of the integration over time: " + blocks;
}

}
