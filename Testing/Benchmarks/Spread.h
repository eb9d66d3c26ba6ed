#ifndef Spread_h
#define Spread_h

#include <vector>

/// What the rounds of a measurement say together. The median is what disturbances by other programs
/// move least.
struct Spread
{
  double median, smallest, largest;
};

/// Of at least one value.
Spread spreadOf(std::vector<double> values);

/// The quotients round by round: what slows the machine down for a while slows both.
std::vector<double> ratios(
  const std::vector<double>& numerators, const std::vector<double>& denominators);

/// Round by round, over series of equally many rounds.
std::vector<double> geometricMeans(const std::vector<std::vector<double>>& series);

#endif
