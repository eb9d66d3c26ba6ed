// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Ellipsoids/EnclosingEllipsoid.h"
#include "Geometry/Vector.h"

#include <algorithm>
#include <cmath>

namespace irradiance
{

/// Bounds a rigid object in one frame by its ellipsoid: a box in the world, and a quick proof that
/// a segment cannot touch the object. It never looks at the object's triangles.
class EllipsoidBound
{
public:
  /// Any finite affine map will do: a reflection, a shear, one that is nearly or exactly singular.
  /// `worldPad` is a length in the world: the caller's own error of the object's points.
  /// If any of the numbers is not finite, the box is all of space and nothing is rejected.
  EllipsoidBound(const EnclosingEllipsoid& ellipsoid, const Box& modelBox,
    const AffineMap& worldFromObject, double worldPad);

  /// Contains all points within `worldPad` (per axis) of the moved object; empty if `modelBox` is.
  const Box& worldBox() const { return worldBox_; }

  /// True only if no point of the closed segment lies within `worldPad` of the moved ellipsoid.
  /// False is always safe, and is the answer when a coordinate is not finite.
  bool rejects(const Vector3& from, const Vector3& to) const noexcept
  {
    const Vector3 p = from - center_;
    const Vector3 q = to - center_;
    const Vector3 start = roundFromWorld_ * p;
    const Vector3 along = roundFromWorld_ * q - start;
    const double squaredLength = along.squaredNorm();
    // A segment without length gives NaN here, which max turns into 0.
    const double position = std::min(1.0, std::max(0.0, -start.dot(along) / squaredLength));
    // The best n is the point of the segment nearest to the centre, in the space that W maps to.
    const Vector3 n = start + position * along;
    if (isSeparated(p, q, n))
    {
      return true;
    }
    // Near a flat body a segment is very long in that space, and rounding tilts n towards it: fix n.
    const double tilt = n.dot(along);
    const bool mayHelp =
      position > 0.0 && position < 1.0 && std::abs(tilt) > kNegligibleTilt * n.squaredNorm();
    return mayHelp && isSeparated(p, q, n - (tilt / squaredLength) * along);
  }

  /// Every point x within `worldPad` of the moved ellipsoid has |roundFromWorld (x - center)| <=
  /// radius. The map roundFromWorld makes the ellipsoid nearly a ball.
  struct Ball
  {
    Matrix3 roundFromWorld;
    Vector3 center;
    double radius;
  };
  Ball ball() const
  {
    const double longestRow = roundFromWorld_.rowwise().norm().maxCoeff();
    return { roundFromWorld_, center_,
      (std::sqrt(radiusSquared_) + longestRow * pad_) * (1 + kRounding) };
  }

private:
  /// The certificate. Let W = roundFromWorld_ and n any vector. The plane with normal N = W^T n has
  /// the ellipsoid, thickened by the pad, on one side; a point x lies strictly on the other if
  ///     N . (x - center) - |N| pad > radius |n|.
  /// If this holds for both ends of a segment, it holds for the whole segment. The proof is valid for
  /// any n, so n need not be accurate. Only the inequality itself is guarded against rounding;
  /// Documentation/Theory.md has the whole argument.
  bool isSeparated(const Vector3& p, const Vector3& q, const Vector3& n) const noexcept
  {
    const Vector3 normal = roundFromWorld_.transpose() * n;
    // The 1-norm is no less than |normal| and needs no square root.
    const double length = normal.lpNorm<1>();
    const double gapP = normal.dot(p) - length * (pad_ + kRounding * p.lpNorm<1>());
    const double gapQ = normal.dot(q) - length * (pad_ + kRounding * q.lpNorm<1>());
    const double gap = std::min(gapP, gapQ);
    // Beyond these limits, or with a NaN, a product may have underflowed or overflowed.
    const bool isInRange =
      (gapP > kSmallest) & (gapQ > kSmallest) & (gapP < kLargest) & (gapQ < kLargest);
    return isInRange & (gap * gap > radiusSquared_ * n.squaredNorm());
  }

  static constexpr double kNegligibleTilt = 0x1p-10;
  static constexpr double kRounding = 0x1p-48; // 32 units in the last place
  static constexpr double kSmallest = 1e-120;
  static constexpr double kLargest = 1e140;

  Vector3 center_;         // in the world
  Matrix3 roundFromWorld_; // makes the ellipsoid nearly a ball, of radius about 1
  double radiusSquared_;   // of a ball that contains it in that space
  double pad_;             // length in the world: worldPad plus the error of the ellipsoid
  Box worldBox_;
};

}
