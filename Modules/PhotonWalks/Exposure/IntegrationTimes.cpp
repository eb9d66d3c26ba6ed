// SPDX-License-Identifier: BSD-3-Clause
#include "Exposure/IntegrationTimes.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace irradiance
{

std::vector<double> timesWithin(const std::vector<double>& steps, const TimeSpan& span)
{
  std::vector<double> times{ span.start };
  std::copy_if(steps.begin(), steps.end(), std::back_inserter(times),
    [&](double step) { return step > span.start && step < span.end; });
  times.push_back(span.end);
  return times;
}

std::vector<double> uniformTimes(const TimeSpan& span, int intervals)
{
  std::vector<double> times;
  times.reserve(static_cast<std::size_t>(intervals) + 1);
  for (int i = 0; i < intervals; ++i)
  {
    times.push_back(span.start + (span.end - span.start) * (static_cast<double>(i) / intervals));
  }
  times.push_back(span.end);
  return times;
}

std::vector<double> firstTimes(
  const std::vector<double>& steps, const TimeSpan& span, int intervals)
{
  const std::vector<double> known = timesWithin(steps, span);
  std::vector<double> times{ span.start };
  std::size_t longest = 0;
  for (std::size_t i = 1; i < known.size(); ++i)
  {
    constexpr double rounding = 1e-9;
    const double parts = (known[i] - known[i - 1]) / (span.end - span.start) * intervals;
    const auto gap = uniformTimes(
      { known[i - 1], known[i] }, std::max(1, static_cast<int>(std::ceil(parts - rounding))));
    for (std::size_t part = 1; part < gap.size(); ++part)
    {
      times.push_back(gap[part]);
      const std::size_t end = times.size() - 1;
      longest = longest == 0 || times[end] - times[end - 1] > times[longest] - times[longest - 1]
        ? end
        : longest;
    }
  }
  if (times.size() % 2 == 0)
  {
    times.insert(times.begin() + static_cast<std::ptrdiff_t>(longest),
      middleOf(times[longest - 1], times[longest]));
  }
  return times;
}

namespace
{

void addTo(std::vector<IntervalMeasure>& sums, const std::vector<IntervalMeasure>& blocks)
{
  sums.resize(std::max(sums.size(), blocks.size()));
  for (std::size_t i = 0; i < blocks.size(); ++i)
  {
    sums[i].energy += blocks[i].energy;
    sums[i].error += blocks[i].error;
    sums[i].noise += blocks[i].noise;
  }
}

/// The largest error of a block, or the largest noise, relative to the energy of the block.
double worstShare(const std::vector<IntervalMeasure>& blocks,
  const std::vector<IntervalMeasure>& totals, double IntervalMeasure::*part)
{
  double worst = 0;
  for (std::size_t i = 0; i < blocks.size(); ++i)
  {
    worst = blocks[i].*part > 0 ? std::max(worst, blocks[i].*part / totals[i].energy) : worst;
  }
  return worst;
}

/// Whether there are numbers between its times.
bool canHalve(const HalvableInterval& interval)
{
  const auto hasMiddle = [](double start, double end) {
    return start < middleOf(start, end) && middleOf(start, end) < end;
  };
  return hasMiddle(interval.start, interval.middle) && hasMiddle(interval.middle, interval.end);
}

}

std::vector<IntervalMeasure> TimeHalving::totals() const
{
  std::vector<IntervalMeasure> totals = settled_;
  for (const HalvableInterval& interval : open_)
  {
    addTo(totals, interval.blocks);
  }
  return totals;
}

double TimeHalving::relativeError() const
{
  const std::vector<IntervalMeasure> all = totals();
  return worstShare(all, all, &IntervalMeasure::error);
}

double TimeHalving::relativeNoise() const
{
  const std::vector<IntervalMeasure> all = totals();
  return worstShare(all, all, &IntervalMeasure::noise);
}

bool TimeHalving::isSettled(
  const HalvableInterval& interval, const std::vector<IntervalMeasure>& totals) const
{
  const double share = 0.5 * tolerance_ * (interval.end - interval.start) / span_;
  for (std::size_t i = 0; i < totals.size(); ++i)
  {
    // What is certain already: more will come, and what is in doubt may turn out to be nothing.
    const double certain = std::max(0.0, totals[i].energy - totals[i].error);
    if (interval.blocks[i].error > share * certain)
    {
      return false;
    }
  }
  return true;
}

std::vector<std::size_t> TimeHalving::takeSettled()
{
  const std::vector<IntervalMeasure> all = totals();
  const auto firstSettled = std::stable_partition(open_.begin(), open_.end(),
    [&](const HalvableInterval& interval) { return !isSettled(interval, all); });
  std::vector<std::size_t> ids;
  for (auto interval = firstSettled; interval != open_.end(); ++interval)
  {
    addTo(settled_, interval->blocks);
    settledIntervals_ += 2;
    ids.push_back(interval->id);
  }
  open_.erase(firstSettled, open_.end());
  return ids;
}

std::optional<std::size_t> TimeHalving::takeWorst()
{
  const std::vector<IntervalMeasure> all = totals();
  const std::size_t intervals = settledIntervals_ + 2 * open_.size();
  if (relativeError() <= tolerance_ || intervals + 2 > mostIntervals_)
  {
    return std::nullopt;
  }
  auto worst = open_.end();
  double most = 0;
  for (auto interval = open_.begin(); interval != open_.end(); ++interval)
  {
    const double error = worstShare(interval->blocks, all, &IntervalMeasure::error);
    if (error > most && canHalve(*interval))
    {
      most = error;
      worst = interval;
    }
  }
  if (worst == open_.end())
  {
    return std::nullopt;
  }
  const std::size_t id = worst->id;
  open_.erase(worst);
  return id;
}

}
