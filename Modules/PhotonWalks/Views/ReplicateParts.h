// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_ReplicateParts_h
#define irradiance_ReplicateParts_h

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace irradiance
{

/// The standard error of a sum of which each replicate has its part, from their scatter: NaN with a
/// single replicate, or if none has anything.
inline double standardErrorOf(const std::vector<double>& parts)
{
  const auto count = static_cast<double>(parts.size());
  const double sum = std::accumulate(parts.begin(), parts.end(), 0.0);
  double squares = 0;
  for (const double part : parts)
  {
    squares += (count * part - sum) * (count * part - sum);
  }
  return count > 1 && sum > 0 ? std::sqrt(squares / (count * (count - 1)))
                              : std::numeric_limits<double>::quiet_NaN();
}

}

#endif
