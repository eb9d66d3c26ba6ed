// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <string>

namespace movingteapot
{

/**
 * How far the whole run is, and how long it will still take, on the standard error stream: on a
 * terminal one line that is drawn again and again, elsewhere a plain line every tenth of the way.
 */
class ProgressBar
{
public:
  /** `work`: the sum of all steps, in a unit of the caller's. */
  explicit ProgressBar(double work)
    : Work(work)
  {
  }

  /** Ends the step before it, if there was one. */
  void BeginStep(double work, const std::string& what)
  {
    this->Done += this->Step;
    this->Step = work;
    this->What = what;
    this->SetStepFraction(0.0);
  }

  void SetStepFraction(double stepFraction)
  {
    const double fraction = std::min(1.0, (this->Done + stepFraction * this->Step) / this->Work);
    const auto now = Clock::now();
    const int tenth = int(fraction * 10.0 + 1e-9);
    if (this->OnTerminal ? now < this->NextTime : tenth < this->NextTenth)
    {
      return;
    }
    this->NextTime = now + std::chrono::milliseconds(100);
    this->NextTenth = tenth + 1;
    const double elapsed = std::chrono::duration<double>(now - this->Start).count();
    const double left = elapsed / fraction - elapsed;
    char time[40] = ""; // too early to tell
    if (fraction >= 0.02)
    {
      std::snprintf(
        time, sizeof time, "%.0f s %s", left > 0 ? left : elapsed, left > 0 ? "left" : "in all");
    }
    char line[160];
    std::snprintf(line, sizeof line, "[%-30.*s] %3.0f %%  %-40.40s %14s", int(30 * fraction),
      "==============================", 100.0 * fraction, this->What.c_str(), time);
    std::cerr << line << (this->OnTerminal ? "\r" : "\n") << std::flush;
  }

  /** Ends the last step, and the line. */
  void Finish()
  {
    this->NextTime = this->Start;
    this->BeginStep(0.0, "done");
    std::cerr << (this->OnTerminal ? "\n" : "");
  }

private:
  using Clock = std::chrono::steady_clock;

  bool OnTerminal = isatty(STDERR_FILENO) != 0;
  double Work;
  double Done = 0.0;
  double Step = 0.0;
  std::string What;
  Clock::time_point Start = Clock::now();
  Clock::time_point NextTime = Start;
  int NextTenth = 1;
};

}
