// SPDX-License-Identifier: BSD-3-Clause
#ifndef ProgressBar_h
#define ProgressBar_h

#include <chrono>
#include <string>

namespace movingteapot
{

/**
 * How far the whole run is, and how long it will still take. On a terminal one line that is drawn
 * again and again; elsewhere one plain line every tenth of the way. Goes to the standard error
 * stream.
 */
class ProgressBar
{
public:
  /** `work`: the sum of all steps, in a unit of the caller's. */
  explicit ProgressBar(double work);

  void BeginStep(double work, const std::string& what);
  void SetStepFraction(double fraction); // 0 to 1
  void EndStep();

  /** Ends the line. */
  void Finish();

private:
  using Clock = std::chrono::steady_clock;

  double Fraction() const;
  std::string Remaining() const;
  void Show(bool evenIfJustShown);
  void ShowBar(bool evenIfJustShown);
  void ShowLine();

  bool OnTerminal;
  double Work;
  double DoneWork = 0.0;
  double StepWork = 0.0;
  double StepFraction = 0.0;
  std::string What;
  Clock::time_point Start = Clock::now();
  Clock::time_point LastShown = Clock::now();
  int LastTenth = 0;
};

}

#endif
