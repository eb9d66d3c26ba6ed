// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_StageTimes_h
#define irradiance_StageTimes_h

#include <array>
#include <chrono>

namespace irradiance
{

/// The stages of a segment, and what a frame does beside them.
enum class Stage
{
  Start,   ///< walks leave their lights
  PreTest, ///< which rays may touch which body, and these rays in the body's space
  Prepare, ///< rays brought to a tree
  Search,
  Confirm, ///< hits in double
  Sides,   ///< from which a surface is hit
  Receive, ///< what cells receive
  Absorb,  ///< which walks survive
  Leave,   ///< where to they go on
  Store,   ///< in the history
  Scan,    ///< for segments that may be stale
  Sort,    ///< these, by what may have become of them
  Rays,    ///< of stored segments
  Remove,  ///< stale tails
  Other
};
constexpr std::size_t kStages = static_cast<std::size_t>(Stage::Other) + 1;

/// Nanoseconds that each stage took.
using StageTimes = std::array<double, kStages>;

/// Where this thread's stages are timed; null, the initial value, if they are not. Only benchmarks
/// are built so that they can be, as the searches are counted.
#ifdef VTKIRRADIANCE_COUNT_QUERIES
inline StageTimes*& stageTimes()
{
  static thread_local StageTimes* times = nullptr;
  return times;
}
#else
constexpr StageTimes* stageTimes()
{
  return nullptr;
}
#endif

/// Adds to a stage what passed since the last one ended, or since the clock was made.
class StageClock
{
public:
  void ends(Stage stage)
  {
    if (StageTimes* const times = stageTimes())
    {
      const Time now = Clock::now();
      times->at(static_cast<std::size_t>(stage)) +=
        std::chrono::duration<double, std::nano>(now - last_).count();
      last_ = now;
    }
  }

  /// What passed since the last stage ended is not this clock's: others have timed it.
  void restarts() { last_ = stageTimes() ? Clock::now() : Time(); }

private:
  using Clock = std::chrono::steady_clock;
  using Time = Clock::time_point;

  Time last_ = stageTimes() ? Clock::now() : Time();
};

}

#endif
