// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <limits>
#include <string>
#include <vector>

/// What a figure has to reach (`bar`), and what it is hoped to reach (`aim`): both, or neither
/// (NaN). Where the aim is smaller than the bar, less is better.
struct Goal
{
  double bar = std::numeric_limits<double>::quiet_NaN();
  double aim = std::numeric_limits<double>::quiet_NaN();
};

/**
 * Writes one measurement to the standard output, as a line of comma-separated values:
 *
 *   "table","row","quantity",value,bar,aim
 *
 * Lines that differ in the value alone are rounds of the same measurement; Report/ takes their
 * median. `row`: what was measured, one of the rivals or of the jobs. `quantity`: what of it, with
 * its unit or with what it is divided by.
 */
inline void report(const std::string& table, const std::string& row, const std::string& quantity,
  double value, const Goal& goal = {})
{
  std::printf("\"%s\",\"%s\",\"%s\",%.10g,%g,%g\n", table.c_str(), row.c_str(), quantity.c_str(),
    value, goal.bar, goal.aim);
}

/// One line for each round.
inline void report(const std::string& table, const std::string& row, const std::string& quantity,
  const std::vector<double>& values, const Goal& goal = {})
{
  for (const double value : values)
  {
    report(table, row, quantity, value, goal);
  }
}
