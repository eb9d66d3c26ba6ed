// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace irradiance
{

/// What a sample chooses among weights.
struct WeightChoice
{
  std::size_t place;
  double weight;
  double rest; ///< in [0, 1): what the choice left of the sample
};

/// What is left of a sample that fell on an interval of this width, `at` from its start; 0 of an
/// interval without width.
inline double restOf(double at, double width)
{
  const double rest = at / width;
  return rest > 0 ? std::min(rest, 1 - 0x1p-53) : 0;
}

/// The weight on which a part of their sum falls; the last one if it falls on no other.
/// `cumulative`: the weights up to and including each.
inline std::size_t placeByWeight(const std::vector<double>& cumulative, double at)
{
  // By bisection without branches, as which half it is cannot be predicted.
  std::size_t first = 0;
  for (std::size_t count = cumulative.size(); count > 1;)
  {
    const std::size_t half = count / 2;
    first += static_cast<std::size_t>(!(at < cumulative[first + half - 1])) * half;
    count -= half;
  }
  return first;
}

/// `sample`: in [0, 1).
inline WeightChoice chooseByWeight(const std::vector<double>& cumulative, double sample)
{
  const double at = sample * cumulative.back();
  const std::size_t place = placeByWeight(cumulative, at);
  const double before = place == 0 ? 0 : cumulative[place - 1];
  const double own = cumulative[place] - before;
  return { place, own, restOf(at - before, own) };
}

/// Whether a sample chooses the first of two, which has this probability. The sample becomes what
/// the choice left of it.
inline bool choosesFirst(double probability, double& sample)
{
  const bool isFirst = sample < probability;
  sample = isFirst ? restOf(sample, probability) : restOf(sample - probability, 1 - probability);
  return isFirst;
}

/// What the unit interval chooses with a density that is linear between two values.
inline double sampleLinear(double u, double first, double last)
{
  const double whole = first + std::sqrt((1 - u) * first * first + u * last * last);
  return whole > 0 ? std::min(u * (first + last) / whole, 1.0) : u;
}

}
