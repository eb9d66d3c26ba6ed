// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_FrontTimes_h
#define irradiance_FrontTimes_h

#include <array>
#include <chrono>

namespace irradiance
{

/// The stages of the cast of a front.
enum class FrontStage
{
  PreTest, ///< which rays may touch which body, and these rays in the body's space
  Prepare,
  Search,
  Confirm
};

/// Nanoseconds that each stage took.
using FrontTimes = std::array<double, 4>;

/// Where this thread's stages are timed; null, the initial value, if they are not. Only benchmarks are
/// built so that they can be, as the searches are counted.
#ifdef VTKIRRADIANCE_COUNT_QUERIES
inline FrontTimes*& frontTimes()
{
  static thread_local FrontTimes* times = nullptr;
  return times;
}
#else
constexpr FrontTimes* frontTimes()
{
  return nullptr;
}
#endif

/// Adds to a stage what passed since the last one ended, or since the clock was made.
class FrontClock
{
public:
  void ends(FrontStage stage)
  {
    if (FrontTimes* const times = frontTimes())
    {
      const Time now = Clock::now();
      times->at(static_cast<std::size_t>(stage)) +=
        std::chrono::duration<double, std::nano>(now - last_).count();
      last_ = now;
    }
  }

private:
  using Clock = std::chrono::steady_clock;
  using Time = Clock::time_point;

  Time last_ = frontTimes() ? Clock::now() : Time();
};

}

#endif
