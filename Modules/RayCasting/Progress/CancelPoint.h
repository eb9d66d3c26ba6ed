// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_CancelPoint_h
#define irradiance_CancelPoint_h

#include <cstddef>
#include <functional>

namespace irradiance
{

/// Long work calls it from time to time; it throws to stop the work. May be empty.
using CancelPoint = std::function<void()>;

/// Calls a cancel point once every few thousand steps of a loop.
class ThrottledCancelPoint
{
public:
  /// `cancelPoint` must outlive the pace.
  explicit ThrottledCancelPoint(const CancelPoint& cancelPoint)
    : cancelPoint_(cancelPoint)
  {
  }

  void step(std::size_t steps = 1)
  {
    constexpr std::size_t kStepsBetween = 4096;
    steps_ += steps;
    if (steps_ >= kStepsBetween && cancelPoint_)
    {
      steps_ = 0;
      cancelPoint_();
    }
  }

private:
  const CancelPoint& cancelPoint_;
  std::size_t steps_ = 0;
};

}

#endif
