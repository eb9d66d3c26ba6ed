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

/// Works on units with the threads of an execution, cut into slices of time, between which it
/// reports progress from 0 to 1 and may be interrupted. The result does not depend on the cuts.
/// `work` works on a unit until it is done or the deadline has passed; returns whether it is done.
/// Throws Interrupted, and what `work` throws.
void runSliced(std::size_t units, Execution& execution,
  const std::function<bool(std::size_t unit, const Deadline& deadline)>& work);

/// The same for small units, each done at once: work(unit).
template <class Work>
void forEachSliced(std::size_t units, Execution& execution, const Work& work)
{
  runSliced(units, execution, [&](std::size_t unit, const Deadline&) {
    work(unit);
    return true;
  });
}

}

#endif
