// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>

namespace irradiance
{

/// The integer nearest to `quanta`, which is at least 0 and below 2^52.
inline std::int64_t nearestQuanta(double quanta)
{
  const double halfMore = quanta + 0.5;
  return static_cast<std::int64_t>(halfMore);
}

/// Radiant power in whole quanta, so that sums are exact in any order and can be undone. A walk
/// starts with LightTable::quantaPerWalk() of them. One or three bands; the unused ones are 0.
struct Power
{
  static constexpr int kMaxBands = 3;

  std::array<std::int64_t, kMaxBands> quanta{};

  std::int64_t& operator[](int band) { return quanta[static_cast<std::size_t>(band)]; }
  std::int64_t operator[](int band) const { return quanta[static_cast<std::size_t>(band)]; }

  std::int64_t largest() const { return *std::max_element(quanta.begin(), quanta.end()); }
  /// In all bands.
  double total() const { return static_cast<double>(quanta[0] + quanta[1] + quanta[2]); }
  bool isZero() const { return quanta == decltype(quanta){}; }

  Power& operator+=(const Power& other)
  {
    for (int band = 0; band < kMaxBands; ++band)
    {
      (*this)[band] += other[band];
    }
    return *this;
  }
  Power& operator-=(const Power& other) { return *this += std::int64_t{ -1 } * other; }
  friend Power operator*(std::int64_t times, Power power)
  {
    for (std::int64_t& quanta : power.quanta)
    {
      quanta *= times;
    }
    return power;
  }
  friend Power operator-(Power a, const Power& b) { return a -= b; }
  friend bool operator==(const Power& a, const Power& b) { return a.quanta == b.quanta; }
};

/// A value for each band, in any unit; 0 in bands that are not there.
struct Bands : std::array<double, Power::kMaxBands>
{
  /// Calculates band by band.
  template <class Calculate>
  Bands with(Bands other, const Calculate& calculate) const
  {
    std::transform(begin(), end(), other.begin(), other.begin(), calculate);
    return other;
  }
  Bands& operator+=(const Bands& other) { return *this = with(other, std::plus<>()); }
  friend Bands operator-(const Bands& a, const Bands& b) { return a.with(b, std::minus<>()); }
  friend Bands operator*(const Bands& a, const Bands& b) { return a.with(b, std::multiplies<>()); }
  friend Bands operator*(double factor, Bands bands)
  {
    for (double& value : bands)
    {
      value *= factor;
    }
    return bands;
  }
  /// The larger value of each band.
  friend Bands larger(const Bands& a, const Bands& b)
  {
    return a.with(b, [](double x, double y) { return std::max(x, y); });
  }
  double largest() const { return *std::max_element(begin(), end()); }
};

}
