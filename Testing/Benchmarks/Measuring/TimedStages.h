// SPDX-License-Identifier: BSD-3-Clause
#ifndef TimedStages_h
#define TimedStages_h

#include "Progress/StageTimes.h"

/// While it lives the stages of this thread are timed; they are not in a build without
/// VTKIRRADIANCE_COUNT_QUERIES.
class TimedStages
{
public:
  TimedStages() { set(&times_); }
  ~TimedStages() { set(nullptr); }
  TimedStages(const TimedStages&) = delete;
  TimedStages& operator=(const TimedStages&) = delete;

  /// Nanoseconds so far.
  double of(irradiance::Stage stage) const { return times_[static_cast<std::size_t>(stage)]; }
  const irradiance::StageTimes& all() const { return times_; }

private:
  static void set([[maybe_unused]] irradiance::StageTimes* times)
  {
#ifdef VTKIRRADIANCE_COUNT_QUERIES
    irradiance::stageTimes() = times;
#endif
  }

  irradiance::StageTimes times_{};
};

#endif
