#include "Measuring/Rounds.h"

#include <algorithm>
#include <cmath>
#include <ctime>

double threadCpuSeconds()
{
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::vector<std::vector<double>> timeInTurns(
  const std::vector<std::function<void()>>& jobs, int rounds)
{
  std::vector<std::vector<double>> seconds(jobs.size());
  for (int round = -1; round < rounds; ++round)
  {
    for (std::size_t i = 0; i < jobs.size(); ++i)
    {
      const double start = threadCpuSeconds();
      jobs[i]();
      const double end = threadCpuSeconds();
      if (round >= 0)
      {
        seconds[i].push_back(end - start);
      }
    }
  }
  return seconds;
}

double medianOf(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

std::vector<double> ratios(
  const std::vector<double>& numerators, const std::vector<double>& denominators)
{
  std::vector<double> quotients = numerators;
  std::transform(quotients.begin(), quotients.end(), denominators.begin(), quotients.begin(),
    std::divides<double>());
  return quotients;
}

std::vector<double> ratios(double numerator, const std::vector<double>& denominators)
{
  return ratios(std::vector<double>(denominators.size(), numerator), denominators);
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
