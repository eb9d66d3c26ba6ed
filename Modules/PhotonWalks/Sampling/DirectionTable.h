// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Vector.h"
#include "Sampling/ElementaryFunctions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace irradiance
{

/**
 * A function of the direction, not negative, between whose values at some polar angles and azimuths
 * is what is linear in both. Elsewhere it is 0. Directions have the coordinates: along the
 * reference of azimuth 0, along that of 90 degrees, along the axis of polar angle 0. Samples have
 * exactly the density of the function.
 */
class DirectionTable
{
public:
  /// Degrees. `polarAngles`: 2 or more within 0..180, none smaller than the one before; one that is
  /// given twice is a jump. `azimuths`: increasing, over 360 degrees at most; a single one: the
  /// function is round about the axis. `values`: finite, >= 0, all polar angles of the first
  /// azimuth, then of the second one. Throws InputError, saying what is wrong and where.
  DirectionTable(
    std::vector<double> polarAngles, std::vector<double> azimuths, std::vector<double> values);

  /// `direction`: a unit vector.
  double value(const Vector3& direction) const;
  /// At angles in radians. `side`: of a jump, -1 below it, +1 above.
  double valueAt(double polar, double azimuth, int side) const;
  /// Over all directions, sr.
  double integral() const { return cumulative_.back(); }
  /// A direction, with the density value() / integral(), which must be positive. `u`: in (0, 1).
  Vector3 sample(const std::array<double, 2>& u) const;
  /// Calls visit(direction, weight) for each part of a grid of a degree or less where the function
  /// is not 0: with the middle of the part, and the integral over it by the midpoint rule.
  template <class Visit>
  void forEachPart(const Visit& visit) const
  {
    constexpr double kWidest = kPi / 180;
    const auto partsOf = [](double width) { return static_cast<int>(std::ceil(width / kWidest)); };
    const std::size_t steps = isRound() ? 1 : azimuths_.size() - 1;
    for (std::size_t step = 0; step < steps; ++step)
    {
      const std::size_t next = isRound() ? step : step + 1;
      const double turn = isRound() ? 2 * kPi : azimuths_[next] - azimuths_[step];
      const int turns = partsOf(turn);
      for (std::size_t angle = 0; angle + 1 < polar_.size(); ++angle)
      {
        const double rise = polar_[angle + 1] - polar_[angle];
        const int rises = partsOf(rise);
        const double largest =
          std::max({ at(step, angle), at(step, angle + 1), at(next, angle), at(next, angle + 1) });
        for (int i = 0; largest > 0 && i < turns * rises; ++i)
        {
          const int row = i / turns;
          const double up = (row + 0.5) / rises, along = (i % turns + 0.5) / turns;
          const double polar = polar_[angle] + up * rise;
          const double value = between(between(at(step, angle), at(step, angle + 1), up),
            between(at(next, angle), at(next, angle + 1), up), along);
          visit(direction(polar, azimuths_[step] + along * turn),
            value * std::sin(polar) * (rise / rises) * (turn / turns));
        }
      }
    }
  }

  friend bool operator==(const DirectionTable& a, const DirectionTable& b)
  {
    return a.polar_ == b.polar_ && a.azimuths_ == b.azimuths_ && a.values_ == b.values_;
  }

private:
  bool isRound() const { return azimuths_.size() == 1; }
  /// Of a plane and an angle, by their numbers.
  double at(std::size_t plane, std::size_t angle) const
  {
    return values_[plane * polar_.size() + angle];
  }
  /// Of the part of a plane up to an angle, for each radian of azimuth.
  double belowAngle(std::size_t plane, std::size_t angle) const
  {
    return below_[plane * polar_.size() + angle];
  }
  /// Between two planes, of which the second has this part.
  double between(double first, double second, double part) const
  {
    return first + part * (second - first);
  }
  Vector3 direction(double polar, double azimuth) const;

  std::vector<double> polar_, azimuths_; ///< radians
  std::vector<SinCos> ofPolar_, ofAzimuth_;
  std::vector<double> values_, below_;
  std::vector<double> cumulative_; ///< integrals up to the end of each step of azimuth
  std::vector<std::uint32_t> angleGuide_, planeGuide_; ///< see addGuide()
};

}
