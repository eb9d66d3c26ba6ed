// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Vector.h"

#include <boost/multiprecision/cpp_int.hpp>

#include <array>
#include <cmath>

// Decides whether a closed segment touches a closed triangle that an affine map has moved, for the
// exact real numbers that the doubles represent. It uses double arithmetic with an error bound, in
// case of doubt quadruple precision with an error bound, and then rationals.

namespace irradiance::exact
{

__extension__ typedef __float128 Quad;
using Rational = boost::multiprecision::cpp_rational;

enum class Touch
{
  No,
  Yes,
  Unknown, ///< the number type is not accurate enough
  Flat     ///< triangle and segment lie in one plane, or the triangle has no area
};

/// A number that may be off by up to `error`.
template <typename T>
struct Bounded
{
  T value;
  T error;

  explicit Bounded(double x = 0.0)
    : value(x)
    , error(0)
  {
  }
  Bounded(T v, T inherited)
    : value(v)
    , error(inherited + kRounding * magnitude(v))
  {
  }

  static T magnitude(T x) { return x < 0 ? -x : x; }
  static constexpr T kRounding = sizeof(T) == sizeof(double) ? T(0x1p-52) : T(0x1p-112);

  friend Bounded operator+(const Bounded& a, const Bounded& b)
  {
    return { a.value + b.value, a.error + b.error };
  }
  friend Bounded operator-(const Bounded& a, const Bounded& b)
  {
    return { a.value - b.value, a.error + b.error };
  }
  friend Bounded operator*(const Bounded& a, const Bounded& b)
  {
    return { a.value * b.value,
      magnitude(a.value) * b.error + magnitude(b.value) * a.error + a.error * b.error };
  }
};

constexpr int kUnknownSign = 2;

template <typename T>
int signOf(const Bounded<T>& x)
{
  // 1 % pays for the rounding of the bound, the constant for underflow.
  const T doubt = x.error * T(1.01) + T(1e-280);
  return x.value > doubt ? 1 : x.value < -doubt ? -1 : kUnknownSign;
}
inline int signOf(const Rational& x)
{
  return x.sign();
}

template <typename Number>
using Vector = std::array<Number, 3>;

template <typename Number>
Number determinant(const Vector<Number>& a, const Vector<Number>& b, const Vector<Number>& c)
{
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
    a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// The corners and `to`, all relative to `from`.
template <typename Number>
struct Configuration
{
  std::array<Vector<Number>, 3> corner;
  Vector<Number> along;

  Configuration(const AffineMap& worldFromObject, const std::array<Vector3, 3>& triangle,
    const Vector3& from, const Vector3& to)
  {
    for (int i = 0; i < 3; ++i)
    {
      const Number start(from[i]);
      along[i] = Number(to[i]) - start;
      for (int k = 0; k < 3; ++k)
      {
        Number sum = Number(worldFromObject.translation[i]) - start;
        for (int j = 0; j < 3; ++j)
        {
          sum = sum + Number(worldFromObject.linear(i, j)) * Number(triangle[k][j]);
        }
        corner[k][i] = sum;
      }
    }
  }
};

template <typename Number>
Touch touch(const Configuration<Number>& c)
{
  const std::array<int, 3> around = { signOf(determinant(c.along, c.corner[0], c.corner[1])),
    signOf(determinant(c.along, c.corner[1], c.corner[2])),
    signOf(determinant(c.along, c.corner[2], c.corner[0])) };
  const auto has = [&](int sign) {
    return around[0] == sign || around[1] == sign || around[2] == sign;
  };
  if (has(1) && has(-1))
  {
    return Touch::No;
  }
  std::array<Vector<Number>, 3> fromTo;
  for (int k = 0; k < 3; ++k)
  {
    for (int i = 0; i < 3; ++i)
    {
      fromTo[k][i] = c.corner[k][i] - c.along[i];
    }
  }
  const int sideOfFrom = signOf(determinant(c.corner[0], c.corner[1], c.corner[2]));
  const int sideOfTo = signOf(determinant(fromTo[0], fromTo[1], fromTo[2]));
  if (sideOfFrom == sideOfTo && (sideOfFrom == 1 || sideOfFrom == -1))
  {
    return Touch::No;
  }
  if (has(kUnknownSign) || sideOfFrom == kUnknownSign || sideOfTo == kUnknownSign)
  {
    return Touch::Unknown;
  }
  const bool isFlat = (sideOfFrom == 0 && sideOfTo == 0) || !(has(1) || has(-1));
  return isFlat ? Touch::Flat : Touch::Yes;
}

inline Touch touch(const AffineMap& worldFromObject, const std::array<Vector3, 3>& triangle,
  const Vector3& from, const Vector3& to)
{
  Touch answer = touch(Configuration<Bounded<double>>(worldFromObject, triangle, from, to));
  if (answer == Touch::Unknown)
  {
    answer = touch(Configuration<Bounded<Quad>>(worldFromObject, triangle, from, to));
  }
  if (answer == Touch::Unknown)
  {
    answer = touch(Configuration<Rational>(worldFromObject, triangle, from, to));
  }
  return answer;
}

}
