// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_ErrorControlledIntegral_h
#define irradiance_ErrorControlledIntegral_h

#include "Exposure/AdaptiveTrapezoids.h"
#include "Exposure/ExposureNode.h"
#include "Time/ExposureIntegral.h"

#include <string>
#include <vector>

namespace irradiance
{

/// The trapezoidal rule over intervals that are halved until their error, as estimated, is small
/// enough.
class ErrorControlledIntegral : public ExposureIntegral
{
public:
  /// `firstTimes`: in order, an odd number from 3 on.
  ErrorControlledIntegral(std::vector<double> firstTimes, double tolerance, int mostIntervals);

  bool isDone() const override { return rule_.isDone(); }
  std::vector<double> nextTimes(std::size_t most) const override { return rule_.nextTimes(most); }
  void take(vtkDataObject* data) override;
  double progress() const override { return rule_.progress(); }
  double relativeError() const override { return rule_.halving().relativeError(); }
  double relativeNoise() const override { return rule_.halving().relativeNoise(); }
  std::string shortfall() const override;

private:
  /// The input at one time.
  struct Sample : TimedData
  {
    ExposureNode node;
  };

  double lastTime_, tolerance_;
  int mostIntervals_;
  AdaptiveTrapezoids<Sample, ExposureSums> rule_;
  ExposureSums checks_; ///< of all that is taken, with weights of 0: whether it fits together
  std::vector<ExposureBlock> blocks_;
};

}

#endif
