// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Execution_h
#define irradiance_Execution_h

#include "Execution/Ranks.h"
#include "Progress/CancelPoint.h"

#include <chrono>
#include <cstddef>
#include <exception>
#include <functional>

namespace irradiance
{

/// Gives the engine its threads and ranks, and takes its reports of progress. This one is serial,
/// alone and silent.
class Execution
{
public:
  virtual ~Execution() = default;

  /// Calls `task(begin, end)` for ranges that make up [0, count), in any order and possibly at the
  /// same time. `task` does not throw.
  virtual void parallelFor(
    std::size_t count, const std::function<void(std::size_t, std::size_t)>& task)
  {
    task(0, count);
  }

  /// Is called every few hundredths of a second, on the thread that called the engine. `progress`
  /// is 0..1. Returning false stops the engine.
  virtual bool reportProgress(double /*progress*/) { return true; }

  /// The monotonic clock, in seconds, by which a time budget is kept. Many threads call it.
  virtual double seconds() const { return steadySeconds(); }

  /// The one by which work is cut into slices, between which it reports progress.
  virtual double slicingSeconds() const { return steadySeconds(); }

  /// With whom the work is shared.
  virtual Ranks& ranks() { return alone_; }

private:
  static double steadySeconds()
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
  }

  Ranks alone_;
};

/// Execution::reportProgress() returned false.
class Interrupted : public std::exception
{
public:
  const char* what() const noexcept override { return "interrupted"; }
};

/// A cancel point that may be called often. At most every 20 ms it reports `progress`, and throws
/// Interrupted if the report returns false. `execution` must outlive it.
inline CancelPoint cancelPointOf(Execution& execution, double progress)
{
  return [&execution, progress, last = execution.slicingSeconds()]() mutable {
    const double now = execution.slicingSeconds();
    if (now - last < 0.02)
    {
      return;
    }
    last = now;
    if (!execution.reportProgress(progress))
    {
      throw Interrupted();
    }
  };
}

}

#endif
