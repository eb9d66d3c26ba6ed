// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Vector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace pathtracedroom
{

/**
 * A stream of independent numbers, uniform in (0, 1). Number i is a pure function of seed, pass,
 * stream and i, so that paths draw the same numbers in whichever order and thread they are traced.
 * It mixes as SplitMix64 does (Steele, Lea and Flood 2014).
 */
class Random
{
public:
  Random() = default;
  Random(std::uint64_t seed, std::uint64_t pass, std::uint64_t stream)
    : key_(mixed(mixed(mixed(seed) + pass) + stream))
  {
  }

  double next()
  {
    return (static_cast<double>(mixed(key_ + mixed(++count_)) >> 12) + 0.5) * 0x1p-52;
  }
  /// A point of the unit square.
  std::array<double, 2> nextPair()
  {
    const double first = next();
    return { first, next() };
  }

private:
  static std::uint64_t mixed(std::uint64_t x)
  {
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
  }

  std::uint64_t key_ = 0;
  std::uint64_t count_ = 0;
};

/// A unit vector, distributed evenly over the sphere.
inline irradiance::Vector3 sphereDirection(const std::array<double, 2>& u)
{
  const double z = 1 - 2 * u[0], radius = std::sqrt(std::max(0.0, 1 - z * z));
  const double around = 2 * M_PI * u[1];
  return { radius * std::cos(around), radius * std::sin(around), z };
}

/// A unit vector on the side of the unit normal, with the density cosine / pi per steradian: a
/// point of the sphere that touches the surface, as seen from where it touches.
inline irradiance::Vector3 cosineDirection(
  const irradiance::Vector3& normal, const std::array<double, 2>& u)
{
  const irradiance::Vector3 direction = normal + sphereDirection(u);
  const double length = direction.norm();
  return length > 0 ? irradiance::Vector3(direction / length) : normal;
}

/// Barycentric weights of a point that is distributed evenly over a triangle.
inline irradiance::Vector3 evenWeights(const std::array<double, 2>& u)
{
  const double root = std::sqrt(u[0]);
  return { 1 - root, root * (1 - u[1]), root * u[1] };
}

}
