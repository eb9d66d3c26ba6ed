// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Time/ExposureSums.h"

#include "vtkDataObject.h"

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace irradiance
{

/// An integral over time in progress: it says which time it needs next, and takes the data of that
/// time.
class ExposureIntegral
{
public:
  virtual ~ExposureIntegral() = default;

  virtual bool isDone() const = 0;
  /// The times that are needed next, in order, as far as they are known: 1 to `most`; not if done.
  virtual std::vector<double> nextTimes(std::size_t most) const = 0;
  /// Takes the data of the first of these. Throws InputError; then the integral is of no use any more.
  virtual void take(vtkDataObject* data) = 0;
  /// From 0 to 1.
  virtual double progress() const = 0;

  /// The rest is asked when it is done.
  const ExposureSums& sums() const { return sums_; }
  ExposureSums& sums() { return sums_; }
  /// All times, in order.
  const std::vector<double>& times() const { return times_; }
  /// The data of the last of them.
  vtkDataObject* last() const { return last_; }
  /// The estimated error of the integration over time, relative; NaN if there is no estimate.
  double relativeError() const { return relativeError_; }
  /// What looks like such an error, but is the noise of single photons, relative.
  double relativeNoise() const { return relativeNoise_; }
  /// A warning if not all is reached that was asked for, else empty.
  const std::string& shortfall() const { return shortfall_; }

protected:
  ExposureSums sums_;
  std::vector<double> times_;
  vtkSmartPointer<vtkDataObject> last_;
  double relativeError_ = std::numeric_limits<double>::quiet_NaN();
  double relativeNoise_ = relativeError_;
  std::string shortfall_;
};

/// The trapezoidal rule over given times, which are visited in order: two or more, rising.
std::unique_ptr<ExposureIntegral> integralOver(std::vector<double> times);

/// The trapezoidal rule over intervals that are halved until their error, as estimated, is small
/// enough. `firstTimes`: in order, an odd number from 3 on.
std::unique_ptr<ExposureIntegral> errorControlledIntegral(
  std::vector<double> firstTimes, double tolerance, int mostIntervals);

}
