// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_WeightChoice_h
#define irradiance_WeightChoice_h

#include <algorithm>
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

/// `cumulative`: the weights up to and including each. `sample`: in [0, 1).
inline WeightChoice chooseByWeight(const std::vector<double>& cumulative, double sample)
{
  const double at = sample * cumulative.back();
  const auto found = std::upper_bound(cumulative.begin(), cumulative.end() - 1, at);
  const double before = found == cumulative.begin() ? 0 : *(found - 1);
  const double own = *found - before;
  return { static_cast<std::size_t>(found - cumulative.begin()), own, restOf(at - before, own) };
}

}

#endif
