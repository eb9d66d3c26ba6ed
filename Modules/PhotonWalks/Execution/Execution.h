// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Execution_h
#define irradiance_Execution_h

#include "Progress/Checkpoint.h"

#include <chrono>
#include <cstddef>
#include <exception>
#include <functional>

namespace irradiance
{

/// How the engine gets its threads and tells how far it is. This one is serial and silent.
class Execution
{
public:
  virtual ~Execution() = default;

  /// Calls `task(begin, end)` for ranges that make up [0, count), in any order and at once if it
  /// likes. `task` does not throw.
  virtual void parallelFor(
    std::size_t count, const std::function<void(std::size_t, std::size_t)>& task)
  {
    task(0, count);
  }

  /// Called on the engine's own thread every few hundredths of a second; `progress` is 0..1. False
  /// stops the engine.
  virtual bool reportProgress(double /*progress*/) { return true; }

  /// The clock by which the engine keeps to a budget; it never goes back. Asked by many threads.
  virtual double seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
  }
};

/// Execution::reportProgress said no.
class Interrupted : public std::exception
{
public:
  const char* what() const noexcept override { return "interrupted"; }
};

/// A checkpoint that may be called often: every few hundredths of a second it asks whether to go on,
/// and throws Interrupted if not. `execution` must outlive it.
inline Checkpoint checkpointOf(Execution& execution, double progress)
{
  return [&execution, progress, last = std::chrono::steady_clock::now()]() mutable {
    constexpr std::chrono::milliseconds kBetween{ 20 };
    const auto now = std::chrono::steady_clock::now();
    if (now - last < kBetween)
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
