// SPDX-License-Identifier: BSD-3-Clause
#include "ProgressBar.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

#ifdef _WIN32
#include <io.h>
#else
#include <unistd.h>
#endif

namespace movingteapot
{
namespace
{

bool StandardErrorIsTerminal()
{
#ifdef _WIN32
  return _isatty(_fileno(stderr)) != 0;
#else
  return isatty(fileno(stderr)) != 0;
#endif
}

}

ProgressBar::ProgressBar(double work)
  : OnTerminal(StandardErrorIsTerminal())
  , Work(work)
{
}

void ProgressBar::BeginStep(double work, const std::string& what)
{
  this->StepWork = work;
  this->StepFraction = 0.0;
  this->What = what;
  this->Show(false);
}

void ProgressBar::SetStepFraction(double fraction)
{
  this->StepFraction = fraction;
  this->Show(false);
}

void ProgressBar::EndStep()
{
  this->DoneWork += this->StepWork;
  this->StepWork = 0.0;
  this->Show(false);
}

void ProgressBar::Finish()
{
  this->What = "done";
  this->Show(true);
  if (this->OnTerminal)
  {
    std::cerr << std::endl;
  }
}

double ProgressBar::Fraction() const
{
  return std::min(1.0, (this->DoneWork + this->StepFraction * this->StepWork) / this->Work);
}

std::string ProgressBar::Remaining() const
{
  const double elapsed = std::chrono::duration<double>(Clock::now() - this->Start).count();
  const double fraction = this->Fraction();
  if (fraction >= 1.0)
  {
    return std::to_string(std::lround(elapsed)) + " s in all";
  }
  if (fraction < 0.02 || elapsed < 1.0)
  {
    return ""; // too early to tell
  }
  const long seconds = std::lround(elapsed / fraction - elapsed);
  return seconds < 120 ? std::to_string(seconds) + " s left"
                       : std::to_string((seconds + 30) / 60) + " min left";
}

void ProgressBar::Show(bool evenIfJustShown)
{
  if (this->OnTerminal)
  {
    this->ShowBar(evenIfJustShown);
  }
  else
  {
    this->ShowLine();
  }
}

void ProgressBar::ShowBar(bool evenIfJustShown)
{
  const auto now = Clock::now();
  if (!evenIfJustShown && now - this->LastShown < std::chrono::milliseconds(100))
  {
    return;
  }
  this->LastShown = now;
  const int width = 30;
  const int filled = int(this->Fraction() * width);
  char line[160];
  std::snprintf(line, sizeof line, "\r[%s%s] %3.0f %%  %-40.40s %14s",
    std::string(filled, '=').c_str(), std::string(width - filled, ' ').c_str(),
    100.0 * this->Fraction(), this->What.c_str(), this->Remaining().c_str());
  std::cerr << line << std::flush;
}

void ProgressBar::ShowLine()
{
  const int tenth = int(this->Fraction() * 10.0 + 1e-9);
  if (tenth > this->LastTenth)
  {
    this->LastTenth = tenth;
    const std::string remaining = this->Remaining();
    std::cerr << 10 * tenth << " %: " << this->What << (remaining.empty() ? "" : ", ") << remaining
              << std::endl;
  }
}

}
