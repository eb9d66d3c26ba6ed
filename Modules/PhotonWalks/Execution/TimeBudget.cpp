// SPDX-License-Identifier: BSD-3-Clause
#include "Execution/TimeBudget.h"

#include <algorithm>

namespace irradiance
{

std::size_t TimeBudget::itemsToBegin(std::size_t most) const
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

void TimeBudget::spend(double seconds, std::size_t items)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  spent_ += seconds;
  items_ += static_cast<double>(items);
}

}
