// SPDX-License-Identifier: BSD-3-Clause
#include "Time/ExposureIntegral.h"

#include "Exposure/IntegrationTimes.h"

namespace irradiance
{

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
