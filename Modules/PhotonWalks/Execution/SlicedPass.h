// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SlicedPass_h
#define irradiance_SlicedPass_h

#include "Execution/Execution.h"

#include <functional>

namespace irradiance
{

/// The end of a slice of time.
class Deadline
{
public:
  /// 30 ms from now. `execution` must outlive it.
  explicit Deadline(const Execution& execution)
    : execution_(execution)
    , end_(execution.slicingSeconds() + 0.03)
  {
  }

  bool hasPassed() const { return execution_.slicingSeconds() >= end_; }

private:
  const Execution& execution_;
  double end_;
};

/// Units of work for the threads of an execution. The pass is cut into slices of time, between
/// which it reports progress and may be interrupted. The result does not depend on the cuts.
struct SlicedPass
{
  std::size_t units;
  /// Works on a unit until it is done or the deadline has passed; returns whether it is done.
  std::function<bool(std::size_t unit, const Deadline& deadline)> work;

  /// Reports progress from 0 to 1. Throws Interrupted, and what `work` throws.
  void run(Execution& execution) const;
};

}

#endif
