// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_IntensityDistribution_h
#define irradiance_IntensityDistribution_h

#include "Surfaces/Power.h"
#include "Surfaces/SceneObjects.h"

#include <array>
#include <memory>
#include <vector>

namespace irradiance
{

/**
 * Into which directions a luminaire shines, in world space. Of an opening each face gives, in each
 * direction, the part of the light that it has of the opening as that direction sees it. So the
 * radiance is alike all over the opening, and from afar the intensity is the table's. A pose turns
 * the table, and mirrors it; it does not scale it.
 */
class IntensityDistribution
{
public:
  /// `hasShares`: shares are asked for, which takes a while of an opening with several faces.
  IntensityDistribution(
    const Luminaire& lamp, const AffineMap& worldFromObject, bool hasShares = true);

  /// W/sr for each W of the lamp. `direction`: a unit vector, as the light goes.
  double intensity(const Vector3& direction) const
  {
    return table_->value(axes_.transpose() * direction) / table_->integral();
  }
  /// W/m2/sr for each W, of the faces that are seen; 0 if none is, and of a lamp without faces.
  double radiance(const Vector3& direction) const
  {
    const double seen = seenArea(direction);
    return seen > 0 ? intensity(direction) / seen : 0;
  }
  /// All faces that look the same way.
  struct Face
  {
    double area = 0, share = 0; ///< m2; of the light
    /// Of the light that leaves a part of them.
    double shareOf(double itsArea) const { return area > 0 ? share * itsArea / area : 0; }
  };
  /// `normal`: of the front, a unit vector.
  Face faceOf(const Vector3& normal) const;
  /// A direction in which light leaves a lamp without faces, or a face with this normal.
  Vector3 sample(std::array<double, 2> u) const { return axes_ * table_->sample(u); }
  Vector3 sample(std::array<double, 2> u, const Vector3& normal, const Face& face) const;
  /// What to weigh directions by where a lamp or a receiver is wide: it is like the intensity, but
  /// nowhere much less than in the directions beside. Of a face, for each W that leaves it; without
  /// one (of no area), of all of the lamp.
  double roughIntensity(const Vector3& direction, const Vector3& normal, const Face& face) const;

  friend bool operator==(const IntensityDistribution& a, const IntensityDistribution& b)
  {
    return *a.table_ == *b.table_ && a.axes_ == b.axes_ && a.areas_ == b.areas_;
  }

private:
  /// m2, of the opening as it is seen.
  double seenArea(const Vector3& direction) const
  {
    double sum = 0;
    for (const Vector3& area : areas_)
    {
      sum += std::max(0.0, area.dot(direction));
    }
    return sum;
  }

  std::shared_ptr<const DirectionTable> table_;
  Matrix3 axes_;               ///< of the table, as columns
  std::vector<Vector3> areas_; ///< area vectors to the outside, m2
  std::vector<double> shares_; ///< of the light that leaves each
};

/// pi times the radiance of what a side of a cell emits in a direction, W/m2/sr, by band.
Bands emittedFrom(
  const SceneObject& object, std::size_t cell, bool isFront, const Vector3& direction);

/// Both null, or equal.
inline bool isSame(const std::shared_ptr<const IntensityDistribution>& a,
  const std::shared_ptr<const IntensityDistribution>& b)
{
  return a == b || (a && b && *a == *b);
}

}

#endif
