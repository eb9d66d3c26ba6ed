#include "Spread.h"

#include <algorithm>
#include <cmath>

Spread spreadOf(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return { 0.5 * (values[(n - 1) / 2] + values[n / 2]), values.front(), values.back() };
}

std::vector<double> ratios(
  const std::vector<double>& numerators, const std::vector<double>& denominators)
{
  std::vector<double> quotients;
  for (std::size_t round = 0; round < numerators.size(); ++round)
  {
    quotients.push_back(numerators[round] / denominators[round]);
  }
  return quotients;
}

std::vector<double> geometricMeans(const std::vector<std::vector<double>>& series)
{
  std::vector<double> means(series.front().size(), 1.0);
  for (std::size_t round = 0; round < means.size(); ++round)
  {
    for (const std::vector<double>& values : series)
    {
      means[round] *= std::pow(values[round], 1.0 / static_cast<double>(series.size()));
    }
  }
  return means;
}
