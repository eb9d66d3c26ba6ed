// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Stopwatch_h
#define irradiance_Stopwatch_h

#include <chrono>

namespace irradiance
{

/// Measures time from its construction on.
class Stopwatch
{
public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}

#endif
