// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <vector>

#ifdef __SSE2__
#include <pmmintrin.h>
#endif

/// Tells the processor to take denormal numbers for zero in this thread, as Embree's manual
/// advises.
inline void flushDenormals()
{
#ifdef __SSE2__
  _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
  _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
#endif
}

/// CPU time of this thread, which stands still while other programs have the processor.
inline double threadCpuSeconds()
{
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// What a job takes.
template <class Job>
double threadCpuSecondsOf(const Job& job)
{
  const double start = threadCpuSeconds();
  job();
  return threadCpuSeconds() - start;
}

/// Runs the jobs in turns, once to warm up and then `rounds` times, so that whatever disturbs the
/// machine disturbs all of them. Returns seconds of this thread's CPU time: [job][round].
inline std::vector<std::vector<double>> timeInTurns(
  const std::vector<std::function<void()>>& jobs, int rounds)
{
  std::vector<std::vector<double>> seconds(jobs.size());
  for (int round = -1; round < rounds; ++round)
  {
    for (std::size_t i = 0; i < jobs.size(); ++i)
    {
      const double cost = threadCpuSecondsOf(jobs[i]);
      if (round >= 0)
      {
        seconds[i].push_back(cost);
      }
    }
  }
  return seconds;
}

/// Of at least one value. Disturbances by other programs move it least.
inline double medianOf(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

/// The quotients round by round: what slows the machine down for a while slows both.
inline std::vector<double> ratios(
  const std::vector<double>& numerators, const std::vector<double>& denominators)
{
  std::vector<double> quotients = numerators;
  std::transform(quotients.begin(), quotients.end(), denominators.begin(), quotients.begin(),
    std::divides<double>());
  return quotients;
}

/// The quotients of one number and the value of each round.
inline std::vector<double> ratios(double numerator, const std::vector<double>& denominators)
{
  return ratios(std::vector<double>(denominators.size(), numerator), denominators);
}

/// Round by round, over series of equally many rounds.
inline std::vector<double> geometricMeans(const std::vector<std::vector<double>>& series)
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
