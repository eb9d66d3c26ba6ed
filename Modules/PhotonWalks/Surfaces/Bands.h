// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Bands_h
#define irradiance_Bands_h

#include "Surfaces/Power.h"

#include <algorithm>
#include <array>
#include <functional>

namespace irradiance
{

/// A value for each band, in any unit; 0 in bands that are not there.
struct Bands : std::array<double, Power::kMaxBands>
{
  Bands& operator+=(const Bands& other)
  {
    std::transform(begin(), end(), other.begin(), begin(), std::plus<>());
    return *this;
  }
  friend Bands operator-(Bands a, const Bands& b)
  {
    std::transform(a.begin(), a.end(), b.begin(), a.begin(), std::minus<>());
    return a;
  }
  /// Band by band.
  friend Bands operator*(Bands a, const Bands& b)
  {
    std::transform(a.begin(), a.end(), b.begin(), a.begin(), std::multiplies<>());
    return a;
  }
  friend Bands operator*(double factor, Bands bands)
  {
    for (double& value : bands)
    {
      value *= factor;
    }
    return bands;
  }
  /// The larger value of each band.
  friend Bands larger(Bands a, const Bands& b)
  {
    std::transform(
      a.begin(), a.end(), b.begin(), a.begin(), [](double x, double y) { return std::max(x, y); });
    return a;
  }
  double largest() const { return *std::max_element(begin(), end()); }
};

}

#endif
