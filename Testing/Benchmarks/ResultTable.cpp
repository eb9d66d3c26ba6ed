#include "ResultTable.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>

namespace
{

std::string formatted(const char* format, double value)
{
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string goalText(const Goal& goal, double limit)
{
  return std::isnan(limit) ? "" : (goal.isLessBetter() ? "<= " : ">= ") + shortNumber(limit);
}

std::string reached(const Result& result)
{
  const auto reaches = [&](double limit) {
    return result.goal.isLessBetter() ? result.spread.median <= limit
                                      : result.spread.median >= limit;
  };
  if (std::isnan(result.goal.bar))
  {
    return "";
  }
  return reaches(result.goal.aim) ? "aim" : reaches(result.goal.bar) ? "bar" : "no";
}

bool isMatrix(const std::vector<Result>& results)
{
  return distinct(results, &Result::quantity).size() > 1 &&
    std::all_of(results.begin(), results.end(),
      [](const Result& result) { return std::isnan(result.goal.bar); });
}

std::string matrixCell(
  const std::vector<Result>& results, const std::string& row, const std::string& quantity)
{
  const auto found = std::find_if(results.begin(), results.end(),
    [&](const Result& result) { return result.row == row && result.quantity == quantity; });
  if (found == results.end())
  {
    return "";
  }
  const Spread& spread = found->spread;
  if (spread.median == 0 && spread.largest > 0)
  {
    return shortNumber(spread.smallest) + " .. " + shortNumber(spread.largest);
  }
  const double half = 50 * (spread.largest - spread.smallest) / spread.median;
  return shortNumber(spread.median) + (half > 0 ? formatted(" ±%.0f%%", half) : "");
}

void writeMatrix(std::ostream& stream, const std::vector<Result>& results)
{
  const std::vector<std::string> quantities = distinct(results, &Result::quantity);
  std::string rule = "|---|";
  stream << "| |";
  for (const std::string& quantity : quantities)
  {
    stream << ' ' << quantity << " |";
    rule += "---|";
  }
  stream << '\n' << rule << '\n';
  for (const std::string& row : distinct(results, &Result::row))
  {
    stream << "| " << row << " |";
    for (const std::string& quantity : quantities)
    {
      stream << ' ' << matrixCell(results, row, quantity) << " |";
    }
    stream << '\n';
  }
}

void writeList(std::ostream& stream, const std::vector<Result>& results)
{
  stream
    << "| | quantity | median | range | bar | aim | reached |\n|---|---|---|---|---|---|---|\n";
  for (const Result& result : results)
  {
    const Spread& spread = result.spread;
    stream << "| " << result.row << " | " << result.quantity << " | " << shortNumber(spread.median)
           << " | " << shortNumber(spread.smallest) << " .. " << shortNumber(spread.largest)
           << " | " << goalText(result.goal, result.goal.bar) << " | "
           << goalText(result.goal, result.goal.aim) << " | " << reached(result) << " |\n";
  }
}

}

std::string shortNumber(double value)
{
  return std::isnan(value) ? "-" : formatted(std::abs(value) < 1000 ? "%.3g" : "%.0f", value);
}

std::vector<std::string> distinct(const std::vector<Result>& results, std::string Result::*member)
{
  std::vector<std::string> values;
  for (const Result& result : results)
  {
    if (std::find(values.begin(), values.end(), result.*member) == values.end())
    {
      values.push_back(result.*member);
    }
  }
  return values;
}

void writeTable(std::ostream& stream, const std::vector<Result>& results)
{
  isMatrix(results) ? writeMatrix(stream, results) : writeList(stream, results);
}
