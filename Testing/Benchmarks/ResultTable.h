#ifndef ResultTable_h
#define ResultTable_h

#include "Result.h"

#include <iosfwd>

/// Three significant digits, or a dash for what is not a number.
std::string shortNumber(double value);

/// The different values of a member, in the order of their first appearance.
std::vector<std::string> distinct(const std::vector<Result>& results, std::string Result::*member);

/// The results of one benchmark as a Markdown table: a line for each with its range and goal; or,
/// when no result has a goal and there are several quantities, rows by quantities, each with half the
/// range in percent (the range itself where the median is 0).
void writeTable(std::ostream& stream, const std::vector<Result>& results);

#endif
