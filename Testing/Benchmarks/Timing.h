#ifndef Timing_h
#define Timing_h

#include <functional>
#include <vector>

/// CPU time of this thread, which stands still while other programs have the processor.
double threadCpuSeconds();

/// Runs the jobs in turns, once to warm up and then `rounds` times, so that whatever disturbs the
/// machine disturbs all of them. Returns seconds of this thread's CPU time: [job][round].
std::vector<std::vector<double>> timeInTurns(
  const std::vector<std::function<void()>>& jobs, int rounds);

#endif
