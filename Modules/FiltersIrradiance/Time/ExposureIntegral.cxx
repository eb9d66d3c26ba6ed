// SPDX-License-Identifier: BSD-3-Clause
#include "Time/ExposureIntegral.h"

#include "Exposure/IntegrationTimes.h"

#include <algorithm>

namespace irradiance
{

std::vector<double> GivenTimesIntegral::nextTimes(std::size_t most) const
{
  const std::size_t end = std::min(next_ + most, times_.size());
  return { times_.begin() + static_cast<std::ptrdiff_t>(next_),
    times_.begin() + static_cast<std::ptrdiff_t>(end) };
}

void GivenTimesIntegral::take(vtkDataObject* data)
{
  const double time = times_[next_];
  const double before = next_ == 0 ? time : times_[next_ - 1];
  const double after = next_ + 1 == times_.size() ? time : times_[next_ + 1];
  sums_.add({ time, data }, trapezoidWeight(before, after));
  last_ = data;
  ++next_;
}

}
