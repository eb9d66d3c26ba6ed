// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Ellipsoids/EnclosingEllipsoid.h"
#include "ExactSegmentTriangle.h"

#include <array>

// Distances and moved ellipsoids with 113 bits.

namespace irradiance::exact
{

inline Quad dot(const Vector<Quad>& a, const Vector<Quad>& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Vector<Quad> difference(const Vector<Quad>& a, const Vector<Quad>& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

inline Vector<Quad> quad(const Vector3& x)
{
  return { x[0], x[1], x[2] };
}

inline Vector<Quad> moved(const AffineMap& map, const Vector3& point)
{
  Vector<Quad> x = quad(map.translation);
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      x[i] += Quad(map.linear(i, j)) * Quad(point[j]);
    }
  }
  return x;
}

/// The squared distance of `x` from the segment.
inline Quad squaredDistance(const Vector<Quad>& x, const Vector3& from, const Vector3& to)
{
  const Vector<Quad> along = difference(quad(to), quad(from));
  Vector<Quad> d = difference(quad(from), x);
  const Quad length = dot(along, along);
  const Quad t = length > 0 ? -dot(d, along) / length : Quad(0);
  const Quad clamped = t < 0 ? Quad(0) : t > 1 ? Quad(1) : t;
  for (int i = 0; i < 3; ++i)
  {
    d[i] += clamped * along[i];
  }
  return dot(d, d);
}

/// The columns of linear * shape^-1, and the moved centre.
struct QuadEllipsoid
{
  std::array<Vector<Quad>, 3> axis;
  Vector<Quad> center;

  QuadEllipsoid(const EnclosingEllipsoid& e, const AffineMap& map)
    : center(moved(map, e.center))
  {
    std::array<Vector<Quad>, 3> row;
    for (int i = 0; i < 3; ++i)
    {
      row[i] = quad(e.shape.row(i).transpose());
    }
    const Quad volume = determinant(row[0], row[1], row[2]);
    for (int k = 0; k < 3; ++k)
    {
      const Vector<Quad>& a = row[(k + 1) % 3];
      const Vector<Quad>& b = row[(k + 2) % 3];
      for (int i = 0; i < 3; ++i)
      {
        axis[k][i] = 0;
        for (int j = 0; j < 3; ++j)
        {
          const Quad inverse =
            (a[(j + 1) % 3] * b[(j + 2) % 3] - a[(j + 2) % 3] * b[(j + 1) % 3]) / volume;
          axis[k][i] += Quad(map.linear(i, j)) * inverse;
        }
      }
    }
  }

  Quad squaredHalfWidth(int i) const
  {
    return axis[0][i] * axis[0][i] + axis[1][i] * axis[1][i] + axis[2][i] * axis[2][i];
  }
};

}
