#ifndef BarChart_h
#define BarChart_h

#include "Result.h"

/// Draws the medians of one benchmark as bars, a group for each quantity, a colour for each row
/// but that which is 1 everywhere, and writes them to a PNG file. Throws std::runtime_error when it
/// cannot be written.
void writeBarChart(
  const std::string& path, const std::string& valueTitle, const std::vector<Result>& results);

#endif
