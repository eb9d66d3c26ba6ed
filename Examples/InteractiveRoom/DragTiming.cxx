// SPDX-License-Identifier: BSD-3-Clause
#include "DragTiming.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <vector>

namespace interactiveroom
{
namespace
{

using Clock = std::chrono::steady_clock;

double SecondsSince(Clock::time_point begin)
{
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/** What a round of dragging took; s, but for the first. */
struct Round
{
  double FramesASecond, Longest, Verify, Repair;
  double Processor; // of a frame, all threads together; other programs hardly change it
  double ToExact;
  int Steps;    // from release to exact
  double Stale; // share of the emitted power at release
};

double Median(const std::vector<Round>& rounds, double Round::*value)
{
  std::vector<double> values;
  for (const Round& round : rounds)
  {
    values.push_back(round.*value);
  }
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

// Half a metre to each side, with a turn; a second to and fro at 30 frames a second.
Round Drag(RoomWindow& window, LightFollower& light, int frames)
{
  constexpr double amplitude = 0.5, period = 30;
  const double turn = 2 * std::acos(-1.0) / period;
  Round round = {};
  const auto begin = Clock::now();
  const std::clock_t processor = std::clock();
  for (int frame = 0; frame < frames; ++frame)
  {
    const auto one = Clock::now();
    window.GetThings().Move(
      amplitude * (std::sin(turn * (frame + 1)) - std::sin(turn * frame)), 0, 0);
    window.GetThings().Turn(3);
    window.Step();
    round.Longest = std::max(round.Longest, SecondsSince(one));
    round.Verify += light.GetFilter()->GetFigure("VerifySeconds") / frames;
    round.Repair += light.GetFilter()->GetFigure("RepairSeconds") / frames;
  }
  round.Processor = double(std::clock() - processor) / CLOCKS_PER_SEC / frames;
  round.FramesASecond = frames / SecondsSince(begin);
  round.Stale =
    light.GetFilter()->GetFigure("StalePower") / light.GetFilter()->GetFigure("EmittedPower");
  const auto release = Clock::now();
  while (!light.IsExact())
  {
    window.Step();
    ++round.Steps;
  }
  round.ToExact = SecondsSince(release);
  return round;
}

}

void PrintDragTiming(RoomWindow& window, LightFollower& light, int frames)
{
  constexpr int count = 5;
  std::vector<Round> rounds;
  std::printf("%5s %8s %11s %10s %10s %13s %8s %8s %7s\n", "round", "frames/s", "longest, ms",
    "verify, ms", "repair, ms", "processor, ms", "exact, s", "in steps", "stale");
  for (int i = 0; i < count; ++i)
  {
    const Round round = Drag(window, light, frames);
    rounds.push_back(round);
    std::printf("%5d %8.1f %11.1f %10.1f %10.1f %13.1f %8.3f %8d %5.1f %%\n", i + 1,
      round.FramesASecond, 1e3 * round.Longest, 1e3 * round.Verify, 1e3 * round.Repair,
      1e3 * round.Processor, round.ToExact, round.Steps, 100 * round.Stale);
  }
  std::printf("Median: %.1f frames a second while dragging, %.3f s from release to exact.\n",
    Median(rounds, &Round::FramesASecond), Median(rounds, &Round::ToExact));
}

}
