// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_ExposureIntegral_h
#define irradiance_ExposureIntegral_h

#include "Time/ExposureSums.h"

#include "vtkDataObject.h"

#include <limits>
#include <string>
#include <utility>
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
  double nextTime() const { return nextTimes(1).front(); }
  /// Takes the data of nextTime(). Throws InputError; then the integral is of no use any more.
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
  virtual double relativeError() const { return std::numeric_limits<double>::quiet_NaN(); }
  /// What looks like such an error, but is the noise of single photons, relative.
  virtual double relativeNoise() const { return std::numeric_limits<double>::quiet_NaN(); }
  /// A warning if not all is reached that was asked for, else empty.
  virtual std::string shortfall() const { return ""; }

protected:
  ExposureSums sums_;
  std::vector<double> times_;
  vtkSmartPointer<vtkDataObject> last_;
};

/// The trapezoidal rule over given times, which are visited in order.
class GivenTimesIntegral : public ExposureIntegral
{
public:
  /// `times`: two or more, rising.
  explicit GivenTimesIntegral(std::vector<double> times) { times_ = std::move(times); }

  bool isDone() const override { return next_ == times_.size(); }
  std::vector<double> nextTimes(std::size_t most) const override;
  void take(vtkDataObject* data) override;
  double progress() const override
  {
    return static_cast<double>(next_) / static_cast<double>(times_.size());
  }

private:
  std::size_t next_ = 0;
};

}

#endif
