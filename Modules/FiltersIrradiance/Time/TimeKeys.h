// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_TimeKeys_h
#define irradiance_TimeKeys_h

#include <vector>

class vtkInformation;
class vtkInformationVector;

namespace irradiance
{

/// The TIME_STEPS of an input, in order, each once.
std::vector<double> stepsOf(vtkInformation* input);

/// TIME_STEPS and TIME_RANGE of a filter with several inputs: the steps of all of them, and the
/// range that holds all steps and ranges. VTK's executive passes on the times of the first input
/// alone, and a filter without TIME_RANGE does not execute when the time changes.
class TimeKeys
{
public:
  /// The times of all connections of the first `ports` input ports.
  TimeKeys(vtkInformationVector** inputs, int ports);

  void addSteps(const std::vector<double>& steps);
  void addRange(double first, double last);

  /// Sets both keys on all outputs, or removes them where there are no times.
  void write(vtkInformationVector* outputs);

private:
  std::vector<double> steps_; ///< in no order
  double first_, last_;       ///< the range; none if last_ < first_
};

}

#endif
