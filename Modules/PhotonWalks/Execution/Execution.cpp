// SPDX-License-Identifier: BSD-3-Clause
#include "Execution/Execution.h"

namespace irradiance
{

void runSliced(std::size_t units, Execution& execution,
  const std::function<bool(std::size_t unit, const std::function<bool()>& hasToStop)>& work)
{
  std::vector<char> isDone(units, 0);
  std::size_t first = 0; // unit that is not done yet
  while (first < units)
  {
    const std::function<bool()> hasToStop = [&, end = execution.slicingSeconds() + 0.03] {
      return execution.slicingSeconds() >= end;
    };
    std::mutex mutex;
    std::exception_ptr error;
    execution.parallelFor(units - first, [&](std::size_t begin, std::size_t end) {
      try
      {
        for (std::size_t i = first + begin; i < first + end && !hasToStop(); ++i)
        {
          isDone[i] = isDone[i] != 0 || work(i, hasToStop) ? 1 : 0;
        }
      }
      catch (...)
      {
        const std::lock_guard<std::mutex> lock(mutex);
        error = std::current_exception();
      }
    });
    if (error)
    {
      std::rethrow_exception(error);
    }
    first = static_cast<std::size_t>(
      std::find(isDone.begin() + static_cast<std::ptrdiff_t>(first), isDone.end(), 0) -
      isDone.begin());
    const auto done = static_cast<double>(std::count(isDone.begin(), isDone.end(), 1));
    if (!execution.reportProgress(done / static_cast<double>(units)))
    {
      throw Interrupted();
    }
  }
}

}
