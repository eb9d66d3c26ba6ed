#ifndef Rounds_h
#define Rounds_h

#include <functional>
#include <vector>

/// CPU time of this thread, which stands still while other programs have the processor.
double threadCpuSeconds();

/// Runs the jobs in turns, once to warm up and then `rounds` times, so that whatever disturbs the
/// machine disturbs all of them. Returns seconds of this thread's CPU time: [job][round].
std::vector<std::vector<double>> timeInTurns(
  const std::vector<std::function<void()>>& jobs, int rounds);

/// Of at least one value. Disturbances by other programs move it least.
double medianOf(std::vector<double> values);

/// The quotients round by round: what slows the machine down for a while slows both.
std::vector<double> ratios(
  const std::vector<double>& numerators, const std::vector<double>& denominators);
/// The quotients of one number and the value of each round.
std::vector<double> ratios(double numerator, const std::vector<double>& denominators);

/// Round by round, over series of equally many rounds.
std::vector<double> geometricMeans(const std::vector<std::vector<double>>& series);

#endif
