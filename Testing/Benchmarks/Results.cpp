#include "Results.h"

#include "ResultFile.h"
#include "ResultTable.h"

#include <algorithm>
#include <iostream>
#include <iterator>
#include <utility>

Results::Results(std::string program)
  : program_(std::move(program))
{
}

void Results::add(const std::string& benchmark, const std::string& row, const std::string& quantity,
  const std::vector<double>& values, const Goal& goal)
{
  results_.push_back({ benchmark, row, quantity, spreadOf(values), goal });
}

void Results::finish() const
{
  for (const std::string& benchmark : distinct(results_, &Result::benchmark))
  {
    std::vector<Result> table;
    std::copy_if(results_.begin(), results_.end(), std::back_inserter(table),
      [&](const Result& result) { return result.benchmark == benchmark; });
    std::cout << '\n' << benchmark << '\n';
    writeTable(std::cout, table);
  }
  writeResults(program_ + ".csv", results_);
}
