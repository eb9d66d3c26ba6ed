// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

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

/// Sets all of so many values. Much memory takes long to map and fill, so cancel points are in
/// between.
template <class T>
void assignPaced(
  std::vector<T>& values, std::size_t size, const T& value, const CancelPoint& cancelPoint)
{
  constexpr std::size_t kTogether = std::size_t{ 1 } << 16;
  values.clear();
  values.reserve(size);
  while (values.size() < size)
  {
    values.resize(std::min(size, values.size() + kTogether), value);
    if (cancelPoint)
    {
      cancelPoint();
    }
  }
}

}
