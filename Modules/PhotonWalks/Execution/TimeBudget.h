// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_TimeBudget_h
#define irradiance_TimeBudget_h

#include "Execution/Execution.h"

#include <algorithm>
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
  std::size_t itemsToBegin(std::size_t most) const
  {
    constexpr std::size_t kToLearn = 16; // while no cost is known
    const double left = end_ - now();
    if (!(left > 0))
    {
      return 0;
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    if (items_ == 0)
    {
      return std::min(kToLearn, most);
    }
    const double affordable = 0.5 * left * items_;
    return affordable < static_cast<double>(most) * spent_
      ? static_cast<std::size_t>(affordable / spent_)
      : most;
  }
  /// Records what items have cost the thread that did them.
  void spend(double seconds, std::size_t items)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    spent_ += seconds;
    items_ += static_cast<double>(items);
  }

private:
  const Execution& execution_;
  double begin_, end_;
  mutable std::mutex mutex_;
  double spent_ = 0;
  double items_ = 0;
};

}

#endif
