// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <deque>

namespace interactiveroom
{

/** Frames a second over the last second of a motion. */
class FrameRate
{
public:
  void Add()
  {
    const auto now = Clock::now();
    if (!this->Times.empty() && Seconds(this->Times.back(), now) > Pause)
    {
      this->Times.clear(); // the motion before
    }
    this->Times.push_back(now);
    while (Seconds(this->Times.front(), now) > 1)
    {
      this->Times.pop_front();
    }
  }

  /** 0 before the second frame. */
  double Get() const
  {
    return this->Times.size() < 2
      ? 0
      : double(this->Times.size() - 1) / Seconds(this->Times.front(), this->Times.back());
  }

private:
  using Clock = std::chrono::steady_clock;
  static constexpr double Pause = 0.3; // s

  static double Seconds(Clock::time_point from, Clock::time_point to)
  {
    return std::chrono::duration<double>(to - from).count();
  }

  std::deque<Clock::time_point> Times;
};

}
