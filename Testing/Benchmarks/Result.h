#ifndef Result_h
#define Result_h

#include "Spread.h"

#include <limits>
#include <string>

/// What a figure has to reach (`bar`), and what it is hoped to reach (`aim`): both, or neither (NaN).
/// Where the aim is smaller than the bar, less is better.
struct Goal
{
  double bar = std::numeric_limits<double>::quiet_NaN();
  double aim = std::numeric_limits<double>::quiet_NaN();

  bool isLessBetter() const { return aim < bar; }
};

/// A line of a benchmark's table.
struct Result
{
  std::string benchmark; ///< the table it belongs to
  std::string row;       ///< what was measured: one of the rivals, one of the jobs
  std::string quantity;  ///< what of it, with its unit, or what it is divided by
  Spread spread;
  Goal goal;
};

#endif
