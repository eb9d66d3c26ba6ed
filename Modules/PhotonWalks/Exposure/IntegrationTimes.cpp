// SPDX-License-Identifier: BSD-3-Clause
#include "Exposure/IntegrationTimes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
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

}
