// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Ray.h"
#include "Sampling/DirectionSampling.h"
#include "Sampling/DirectionTable.h"
#include "Surfaces/Sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

namespace irradiance
{

class IntensityDistribution;

/**
 * The sky, or the sun: light from infinity. It enters a box in which all of the scene is, and its
 * flux is what enters there. Directions point to where it comes from. The table has the radiance
 * times the area of the box as it is seen from there, which is what rays start by: so between the
 * angles of a table that product is bilinear.
 */
class DistantLight
{
public:
  /// The radiance of a sky.
  explicit DistantLight(const Sky& sky);
  /// Its sun, in all directions of its disc alike.
  static DistantLight sunOf(const Sky& sky);

  /// The flux for each W/m2/sr of the table of a sky, m2 sr; of a sun for each W/m2, m2.
  double extent() const
  {
    return table_ ? table_->integral() : 2 / (1 + cosine_) * meanCrossSection_;
  }
  const Box& bounds() const { return lit_; }
  bool isSky() const { return table_ != nullptr; }
  /// Of a sky: the radiance from a direction, a unit vector, for each W of the light, 1/m2/sr.
  double radiancePerWatt(const Vector3& direction) const;
  Ray leaving(const std::array<double, 2>& place, const std::array<double, 2>& direction) const;
  /// m2, of the box as it is seen along a direction.
  double crossSection(const Vector3& direction) const
  {
    const Vector3 size = lit_.extent();
    return std::abs(direction[0]) * size[1] * size[2] + std::abs(direction[1]) * size[2] * size[0] +
      std::abs(direction[2]) * size[0] * size[1];
  }
  /// Where light that comes from a direction and reaches a place enters the box; for a place
  /// outside, before it could meet anything.
  Vector3 entry(const Vector3& place, const Vector3& direction) const
  {
    const bool isInside =
      (place.array() >= lit_.lower.array()).all() && (place.array() <= lit_.upper.array()).all();
    double length = isInside ? kInfinity : (place - lit_.center()).norm() + lit_.extent().norm();
    for (int axis = 0; axis < 3 && isInside; ++axis)
    {
      const double end = direction[axis] > 0 ? lit_.upper[axis] : lit_.lower[axis];
      length =
        direction[axis] != 0 ? std::min(length, (end - place[axis]) / direction[axis]) : length;
    }
    return place + length * direction;
  }

  /// A part of the sky, alike from pole to pole and around in the sine of the angle, or the sun.
  struct Part
  {
    double upper, lower; ///< cosines to the zenith
    double first, last;  ///< azimuths, radians
    Vector3 middle;      ///< a direction
    double radius;       ///< radians, from there
    double flux;         ///< of the light's
    double solidAngle() const { return (upper - lower) * (last - first); }
  };
  const std::vector<Part>& parts() const { return *parts_; }
  /// Whether any of it may come to the front of a plane, roughly. `normal`: a unit vector.
  bool mayComeTo(const Vector3& normal) const
  {
    const double level = std::hypot(normal[0], normal[1]);
    return std::any_of(parts_->begin(), parts_->end(), [&](const Part& part) {
      const double height = normal[2] > 0 ? part.upper : part.lower;
      return normal.dot(part.middle) > -part.radius && // more than its sine
        (!isSky() || normal[2] * height + level > 0);
    });
  }
  /// A place of a part that the unit square chooses, with what its light brings.
  struct Sample
  {
    Vector3 direction;
    double solidAngle; ///< for which it stands, sr; 0 of a sun without a disc
    double perWatt;    ///< W/m2 on a plane across, for each W of the light
  };
  Sample sample(const Part& part, const std::array<double, 2>& u) const;

  std::shared_ptr<const IntensityDistribution> ofLuminaire; ///< none

  friend bool operator==(const DistantLight& a, const DistantLight& b)
  {
    return a.lit_.lower == b.lit_.lower && a.lit_.upper == b.lit_.upper && a.axis_ == b.axis_ &&
      a.cosine_ == b.cosine_ &&
      (a.table_ == b.table_ || (a.table_ && b.table_ && *a.table_ == *b.table_));
  }

private:
  DistantLight() = default;
  Vector3 inDisc(const std::array<double, 2>& u) const
  {
    const double height = 1 - u[0] * (1 - cosine_);
    return directionAround(axis_, height, std::sqrt(std::max(0.0, 1 - height * height)), u[1]);
  }
  /// With the density of what enters the box.
  Vector3 sampleDisc(std::array<double, 2> u) const;
  std::vector<Part> partsOfSky() const;

  Box lit_;
  std::shared_ptr<const DirectionTable> table_;    ///< of a sky
  Vector3 axis_ = Vector3::UnitZ();                ///< of a sun: to its middle
  double cosine_ = 1;                              ///< of a sun: of its radius
  double meanCrossSection_ = 0;                    ///< of a sun: m2, over its disc
  std::shared_ptr<const std::vector<Part>> parts_; ///< of all copies of a light
};

}
