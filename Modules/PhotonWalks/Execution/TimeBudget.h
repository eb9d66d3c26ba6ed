// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_TimeBudget_h
#define irradiance_TimeBudget_h

#include "Execution/Execution.h"

#include <mutex>

namespace irradiance
{

/// Time that several threads may spend on items whose cost is only learnt by doing them.
class TimeBudget
{
public:
  /// Begins now. `seconds` may be infinite.
  TimeBudget(const Execution& execution, double seconds)
    : execution_(execution)
    , begin_(execution.seconds())
    , end_(begin_ + seconds)
  {
  }

  double now() const { return execution_.seconds(); }
  double elapsed() const { return now() - begin_; }
  /// How many items, at most `most`, a thread should begin together: by the mean cost so far they
  /// take half of the time that is left. 0 if that does not suffice for one.
  std::size_t itemsToBegin(std::size_t most) const;
  /// Records what items have cost the thread that did them.
  void spend(double seconds, std::size_t items);

private:
  const Execution& execution_;
  double begin_, end_;
  mutable std::mutex mutex_;
  double spent_ = 0;
  double items_ = 0;
};

}

#endif
