// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Triangle.h"

namespace irradiance
{

/**
 * Where irradiance is asked for.
 *
 * What is near is measured in a flattened world: distances across the sensor's plane count eight
 * times (as Jensen 1996 flattens his spheres to discs). On a flat surface that changes nothing. But
 * the other face of a board, the ceiling below, the back of a lamp, which face as the sensor does
 * and are dark, are near only to a sensor that must look eight times as far for its photons as they
 * are away; and round objects count for less where they turn away.
 */
struct Sensor
{
  static constexpr double kFlattening = 8;

  Vector3 position; ///< world
  Vector3 normal; ///< world, unit vector to the side from which light comes; 0: from all directions

  friend bool operator==(const Sensor& a, const Sensor& b)
  {
    return a.position == b.position && a.normal == b.normal;
  }

  /// World units. No less than the plain one.
  double squaredDistance(const Vector3& point) const
  {
    const Vector3 away = point - position;
    const double across = normal.dot(away);
    return away.squaredNorm() + (kFlattening * kFlattening - 1) * across * across;
  }
  /// From a vector in the world to the flattened world.
  Matrix3 flattening() const
  {
    return Matrix3::Identity() + (kFlattening - 1) * normal * normal.transpose();
  }
};

/**
 * Which sides of the triangles of an object face the same way as a sensor: those whose world
 * normals are within 45.6 degrees of its own. Photons on such sides count, and so does their area.
 *
 * The angle is as wide as it can be without counting surface that a user would not expect, so
 * few photons of small round objects are lost: a point normal averaged over the two walls of a
 * right-angled edge (cosine .707) faces as both, but no wall of a hexagonal room (.5) as the next.
 */
class Facing
{
public:
  static constexpr double kLeastCosine = 0.7;

  /// `worldFromObject`: the linear part, in any unit. `scale`: a power of two that makes the object
  /// about as large as 1.
  Facing(const Matrix3& worldFromObject, double scale, const Vector3& normal)
    : scale_(scale)
    , normal_(normal)
  {
    // Area vectors are carried over by the cofactors, whatever the map does to lengths and angles.
    for (int i = 0; i < 3; ++i)
    {
      cofactors_.col(i) = worldFromObject.col((i + 1) % 3).cross(worldFromObject.col((i + 2) % 3));
    }
  }

  /// 1: the front faces that way; -1: the back; 0: neither. `triangle`: in the object's space.
  int side(const Triangle& triangle) const { return side(areaVector(triangle)); }
  int side(const Vector3& areaVector) const
  {
    const double with = normal_.dot(areaVector);
    const bool isNear = std::abs(with) >= kLeastCosine * areaVector.norm();
    return !isNear || with == 0 ? 0 : with > 0 ? 1 : -1;
  }
  /// In the world, in some unit; to the front.
  Vector3 areaVector(const Triangle& triangle) const
  {
    return cofactors_ *
      (scale_ * (triangle.b - triangle.a)).cross(scale_ * (triangle.c - triangle.a));
  }

private:
  double scale_;
  Matrix3 cofactors_;
  Vector3 normal_;
};

}
