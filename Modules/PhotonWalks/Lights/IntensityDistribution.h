// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Sampling/SobolPoint.h"
#include "Surfaces/Power.h"
#include "Surfaces/SceneObjects.h"

#include <algorithm>
#include <array>
#include <cmath>
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
  /// Normals go with the inverse, so that they stay across what they were across.
  IntensityDistribution(
    const Luminaire& lamp, const AffineMap& worldFromObject, bool hasShares = true)
    : table_(lamp.intensity)
  {
    const Matrix3& linear = worldFromObject.linear;
    const double determinant = linear.determinant();
    const Matrix3 ofNormals = std::abs(determinant) * linear.inverse().transpose();
    const Vector3 axis = (ofNormals * lamp.axis).normalized(),
                  reference = (linear * lamp.reference).normalized();
    axes_ << reference, (determinant < 0 ? -1 : 1) * reference.cross(axis), axis;
    for (const Vector3& face : lamp.faces)
    {
      areas_.push_back(ofNormals * face);
    }
    shares_.assign(areas_.size(), areas_.size() == 1 ? 1 : 0);
    if (areas_.size() < 2 || !hasShares)
    {
      return;
    }
    double sum = 0;
    table_->forEachPart([&](const Vector3& local, double weight) {
      const Vector3 direction = axes_ * local;
      const double seen = seenArea(direction);
      for (std::size_t i = 0; i < areas_.size() && seen > 0; ++i)
      {
        shares_[i] += weight * std::max(0.0, areas_[i].dot(direction)) / seen;
      }
      sum += seen > 0 ? weight : 0;
    });
    for (double& share : shares_)
    {
      share = sum > 0 ? share / sum : 0;
    }
  }

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
  Face faceOf(const Vector3& normal) const
  {
    /// Cosine between normals of triangles and of the face of which they are a part.
    constexpr double kParallel = 1 - 4e-6;
    Face face;
    for (std::size_t i = 0; i < areas_.size(); ++i)
    {
      if (areas_[i].dot(normal) >= kParallel * areas_[i].norm())
      {
        face.area += areas_[i].norm();
        face.share += shares_[i];
      }
    }
    return face;
  }
  /// A direction in which light leaves a lamp without faces, or a face with this normal.
  Vector3 sample(std::array<double, 2> u) const { return axes_ * table_->sample(u); }
  /// By rejection, unless the opening is flat: then a direction in front of it is always taken.
  Vector3 sample(std::array<double, 2> u, const Vector3& normal, const Face& face) const
  {
    constexpr int kMostTries = 1 << 16; // beyond any lamp: a face with less light has no share
    for (int i = 0; i < kMostTries; ++i)
    {
      Vector3 direction = sample(u);
      const double ofFace = face.area * normal.dot(direction);
      if (ofFace > 0)
      {
        if (areas_.size() == 1 || otherSquare(u)[0] * seenArea(direction) <= ofFace)
        {
          return direction;
        }
      }
      u = otherSquare({ u[1], u[0] });
    }
    return normal;
  }
  /// What to weigh directions by where a lamp or a receiver is wide: it is like the intensity, but
  /// nowhere much less than in the directions beside. Of a face, for each W that leaves it; without
  /// one (of no area), of all of the lamp.
  double roughIntensity(const Vector3& direction, const Vector3& normal, const Face& face) const
  {
    constexpr double kAlike = 0.1, kSphere = 4 * kPi; // the part that leaves to all sides alike
    const double whole = (1 - kAlike) * intensity(direction) + kAlike / kSphere;
    if (!(face.area > 0 && face.share > 0))
    {
      return whole;
    }
    constexpr double kSlack = 0.05; // of the cosine
    const double seen = face.area * (std::max(0.0, normal.dot(direction)) + kSlack);
    return whole * seen / (seenArea(direction) + kSlack * face.area) / face.share;
  }

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
inline Bands emittedFrom(
  const SceneObject& object, std::size_t cell, bool isFront, const Vector3& direction)
{
  Bands emitted{};
  if (!isFront || !object.hasExitance(cell))
  {
    return emitted;
  }
  if (const Luminaire* const lamp = object.emission->luminaireOf(cell))
  {
    const double radiance =
      IntensityDistribution(*lamp, object.worldFromObject, false).radiance(direction);
    std::transform(lamp->flux.begin(), lamp->flux.end(), emitted.begin(),
      [radiance](double watts) { return kPi * radiance * watts; });
    return emitted;
  }
  const double* const exitance = object.exitanceOf(cell);
  std::copy(exitance, exitance + object.emission->bands, emitted.begin());
  return emitted;
}

/// Both null, or equal.
inline bool isSame(const std::shared_ptr<const IntensityDistribution>& a,
  const std::shared_ptr<const IntensityDistribution>& b)
{
  return a == b || (a && b && *a == *b);
}

}
