// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SlicedPass_h
#define irradiance_SlicedPass_h

#include "Execution/Execution.h"

#include <functional>

namespace irradiance
{

/// Works on units with the threads of an execution, cut into slices of 30 ms, between which it
/// reports progress from 0 to 1 and may be interrupted. The result does not depend on the cuts.
/// `work` works on a unit until it is done or its slice is over; returns whether it is done. Throws
/// Interrupted, and what `work` throws.
void runSliced(std::size_t units, Execution& execution,
  const std::function<bool(std::size_t unit, const std::function<bool()>& hasToStop)>& work);

/// The same for small units, each done at once: work(unit).
template <class Work>
void forEachSliced(std::size_t units, Execution& execution, const Work& work)
{
  runSliced(units, execution, [&](std::size_t unit, const auto&) {
    work(unit);
    return true;
  });
}

}

#endif
