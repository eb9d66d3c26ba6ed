// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_test_TickingExecution_h
#define irradiance_test_TickingExecution_h

#include "ThreadExecution.h"

#include <cstdint>

namespace irradiance::test
{

/// Its clock advances by a tick at every reading: with one thread a budget ends at the same walk
/// every time.
class TickingExecution : public ThreadExecution
{
public:
  static constexpr double kTick = 1e-3; ///< s

  explicit TickingExecution(unsigned threads = 1)
    : ThreadExecution(threads)
  {
  }
  double seconds() const override { return kTick * static_cast<double>(ticks_++); }
  std::int64_t ticks() const { return ticks_; }

private:
  mutable std::atomic<std::int64_t> ticks_{ 0 };
};

}

#endif
