#ifndef LineChart_h
#define LineChart_h

#include "Result.h"

/// What stands on an axis.
struct LineAxis
{
  std::string quantity;
  bool isLogarithmic = false; ///< then all values are positive; else it begins at 0
};

/// Draws the medians of two quantities of one benchmark against each other and writes them to a PNG
/// file. Rows with the same text before their last comma are points of one line, or a mark if there
/// is only one; those with the same text before their first comma have the same colour. Throws
/// std::runtime_error when it cannot be written.
void writeLineChart(const std::string& path, const LineAxis& bottom, const LineAxis& left,
  const std::vector<Result>& results);

#endif
