#include "Timing.h"

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
