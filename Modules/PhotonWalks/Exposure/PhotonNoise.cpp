// SPDX-License-Identifier: BSD-3-Clause
#include "Exposure/PhotonNoise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace irradiance
{

namespace
{

/// Of the values 0 to n - 1, pairs of neighbours are added up; a last one without neighbour stays.
void addPairs(std::vector<double>& values, std::size_t n)
{
  for (std::size_t i = 0; i < n / 2; ++i)
  {
    values[i] = values[2 * i] + values[2 * i + 1];
  }
  if (n % 2 == 1)
  {
    values[n / 2] = values[n - 1];
  }
}

}

NoisyDifference splitDifference(std::vector<double> differences, std::vector<double> variances)
{
  constexpr double deviations = 3; // by chance, 0.0008 deviations are beyond on the average
  double all = 0, signal = 0;
  for (const double difference : differences)
  {
    all += std::abs(difference);
  }
  for (std::size_t n = differences.size(); n > 0; n = n == 1 ? 0 : n - n / 2)
  {
    double beyond = 0;
    for (std::size_t i = 0; i < n; ++i)
    {
      beyond += std::max(0.0, std::abs(differences[i]) - deviations * std::sqrt(variances[i]));
    }
    signal = std::max(signal, beyond);
    addPairs(differences, n);
    addPairs(variances, n);
  }
  signal = std::min(signal, all); // sums are rounded
  return { signal, all - signal };
}

}
