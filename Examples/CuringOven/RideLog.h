// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ProductionLine.h"

#include <vtkSmartPointer.h>

#include <chrono>
#include <exception>
#include <functional>
#include <string>
#include <vector>

class vtkDataArray;
class vtkIrradianceFilter;
class vtkMultiBlockDataSet;

namespace curingoven
{

/** One time of the ride. Powers in W. */
struct Step
{
  double Time = 0;         // s
  double Emitted = 0;      // by the lamps
  double Absorbed = 0;     // by oven and parts
  double Escaped = 0;      // through the openings
  double OnParts = 0;      // received by the parts
  double ChangedWalks = 0; // share of the walks; of the first step: 1
  double ShotSegments = 0; // share of the segments that was shot again
  double Seconds = 0;      // that the light took
  double FreshSeconds = 0; // that a fresh start took; 0: there was none
};

/**
 * Watches the light while the dose filter leads it through time. Each step has to close its power
 * balance exactly, and some are compared with a fresh start, bit for bit.
 */
class RideLog
{
public:
  /** `show` is called for each step, after its light is computed. */
  RideLog(const OvenOptions& options, const std::vector<Part>& parts, vtkIrradianceFilter* light,
    std::function<void(int step, double time)> show);

  const std::vector<Step>& GetSteps() const { return this->Steps; }
  /** Throws what was found wrong on the way: VTK does not let exceptions through. */
  void ThrowIfWrong() const;
  /** Steps.csv. */
  void Write(const std::string& folder) const;

private:
  using Clock = std::chrono::steady_clock;

  void BeginStep();
  void EndStep();
  double PowerOnParts(vtkMultiBlockDataSet* scene) const;
  void Check(const Step& step) const;
  double CompareWithFreshStart(double time);

  const OvenOptions Options;
  const std::vector<Part>& Parts;
  vtkIrradianceFilter* Light;
  std::function<void(int, double)> Show;
  std::vector<vtkSmartPointer<vtkDataArray>> Areas; // of the cells of each part, m2
  std::vector<Step> Steps;
  Clock::time_point Begin;
  std::exception_ptr Wrong;
};

}
