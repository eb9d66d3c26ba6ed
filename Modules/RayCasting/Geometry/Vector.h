// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <limits>

namespace irradiance
{

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

constexpr double kPi = 3.14159265358979323846;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// x -> linear * x + translation. Variables name both frames: `worldFromObject`.
struct AffineMap
{
  Matrix3 linear = Matrix3::Identity();
  Vector3 translation = Vector3::Zero();

  Vector3 operator()(const Vector3& point) const { return linear * point + translation; }

  friend bool operator==(const AffineMap& a, const AffineMap& b)
  {
    return a.linear == b.linear && a.translation == b.translation;
  }
  friend bool operator!=(const AffineMap& a, const AffineMap& b) { return !(a == b); }
};

/// Axis-aligned closed box; empty until something is added.
struct Box
{
  Vector3 lower = Vector3::Constant(kInfinity);
  Vector3 upper = Vector3::Constant(-kInfinity);

  bool isEmpty() const { return !(lower.array() <= upper.array()).all(); }
  void add(const Vector3& point)
  {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  void add(const Box& other)
  {
    lower = lower.cwiseMin(other.lower);
    upper = upper.cwiseMax(other.upper);
  }
  void inflate(double pad)
  {
    lower.array() -= pad;
    upper.array() += pad;
  }
  Box intersection(const Box& other) const
  {
    return { lower.cwiseMax(other.lower), upper.cwiseMin(other.upper) };
  }
  Vector3 center() const { return 0.5 * lower + 0.5 * upper; }
  Vector3 extent() const { return upper - lower; }
  /// Largest extent; 0 when empty.
  double size() const { return isEmpty() ? 0.0 : extent().maxCoeff(); }
  /// Largest absolute coordinate; 0 when empty.
  double magnitude() const
  {
    return isEmpty() ? 0.0 : lower.cwiseAbs().cwiseMax(upper.cwiseAbs()).maxCoeff();
  }
};

/// Bounds of a box that a map has moved; empty if the box is empty. Not rounded outwards.
inline Box movedBox(const AffineMap& map, const Box& box)
{
  if (box.isEmpty())
  {
    return {};
  }
  const Vector3 center = map(box.center());
  const Vector3 reach = 0.5 * map.linear.cwiseAbs() * box.extent();
  return { center - reach, center + reach };
}

}
