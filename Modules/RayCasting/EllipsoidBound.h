#ifndef irradiance_EllipsoidBound_h
#define irradiance_EllipsoidBound_h

#include "EnclosingEllipsoid.h"
#include "Vector.h"

#include <algorithm>
#include <cmath>

namespace irradiance
{

/// Where a rigid object is in one frame, from its ellipsoid alone: a box in the world, and a quick
/// proof that a segment cannot touch the object. It never looks at the object's triangles.
class EllipsoidBound
{
public:
  /// Any finite affine map will do: a reflection, a shear, one that is nearly or exactly singular.
  /// `worldPad` is a length in the world: the caller's own rounding of the object's points.
  /// If any of the numbers is not finite, the box is all of space and nothing is rejected.
  EllipsoidBound(const EnclosingEllipsoid& ellipsoid, const Box& modelBox,
    const AffineMap& worldFromObject, double worldPad);

  /// Contains all points within `worldPad` (per axis) of the moved object; empty if `modelBox` is.
  const Box& worldBox() const { return worldBox_; }

  /// True only if no point of the closed segment lies within `worldPad` of the moved ellipsoid.
  /// False is always safe, and is the answer when a coordinate is not finite.
  bool rejects(const Vector3& from, const Vector3& to) const noexcept;

private:
  void locate(const EnclosingEllipsoid& ellipsoid, const AffineMap& worldFromObject);
  void prepareRejection(double worldPad);
  Box boxOfEllipsoid() const;

  Vector3 center_;        // in the world
  Matrix3 semiAxes_;      // columns: takes the unit ball to the ellipsoid around center_
  double uncertainty_;    // length: how far center_ and semiAxes_ may be off, together
  Matrix3 roundFromWorld_; // makes the ellipsoid about round; only a guide, it may be inaccurate
  double margin_;         // length: worldPad and all errors that do not depend on the segment
  Box worldBox_;
};

// The certificate. A plane with normal N has the ellipsoid (thickened by `margin_`) on one side if
//     N . (x - center) > |semiAxes^T N| + |N| * margin
// and it separates the segment if that holds for both ends. Whatever N is, the proof stands, so
// N need not be accurate: it belongs to the point of the segment nearest to the centre in the
// space where the ellipsoid is round. Only the two sides of the inequality are guarded against
// rounding; Documentation/Theory.md has the proof.
inline bool EllipsoidBound::rejects(const Vector3& from, const Vector3& to) const noexcept
{
  const Vector3 toFrom = from - center_;
  const Vector3 toTo = to - center_;
  const Vector3 a = roundFromWorld_ * toFrom;
  const Vector3 b = roundFromWorld_ * toTo;
  const Vector3 along = b - a;
  const double position = -a.dot(along) / along.squaredNorm(); // NaN for a point: taken as its end
  const Vector3 nearest = position < 1.0 ? Vector3(a + std::max(0.0, position) * along) : b;
  const Vector3 normal = roundFromWorld_.transpose() * nearest;

  const double reachFrom = normal.dot(toFrom);
  const double reachTo = normal.dot(toTo);
  const double normalSquared = normal.squaredNorm();
  const double length = std::sqrt(normalSquared);
  const double support = (semiAxes_.transpose() * normal).norm() + length * margin_;
  const double rounding = length * 0x1p-48; // 32 units in the last place
  const bool isSeparated = reachFrom > support + rounding * toFrom.lpNorm<1>() &&
    reachTo > support + rounding * toTo.lpNorm<1>();
  // Outside these ranges a product may have overflowed or vanished.
  const bool isInRange = normalSquared > 1e-200 && normalSquared < 1e200 && reachFrom < 1e300 &&
    reachTo < 1e300;
  return isSeparated && isInRange;
}

}

#endif
