// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Lights/LampPiece.h"
#include "Sampling/SphericalTriangle.h"
#include "Sampling/WeightChoice.h"

#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace irradiance
{

/// The barycentric weights of a place in the plane of a triangle; some are negative beside the
/// triangle.
Vector3 weightsInPlane(const Triangle& triangle, const Vector3& place);

/// A point that receives light, from one side or from all directions.
struct LitPoint
{
  Vector3 position; ///< world; clear of the surface on which it stands
  Vector3 normal;   ///< unit vector, to the side that receives; 0: it receives from all directions
  TriangleId on{};  ///< the triangle on which it stands; none in the air

  bool hasNormal() const { return !normal.isZero(0); }
  /// How much of a beam along a vector it receives: the cosine, not positive from behind; 1 without
  /// a normal.
  double partOf(const Vector3& along) const
  {
    return hasNormal() ? -normal.dot(along) / along.norm() : 1;
  }

  /// On a side of a triangle, at the point nearest to a place in its plane, roughly.
  static LitPoint onTriangle(
    const Triangle& worldTriangle, const TriangleId& id, bool isFront, const Vector3& place)
  {
    // At an edge, rounding may leave the place beside the triangle.
    const Vector3 weights = weightsInPlane(worldTriangle, place).cwiseMax(0);
    SurfacePoint point = surfacePoint(worldTriangle, weights / weights.sum());
    point.turn(isFront);
    return { point.clearPosition(), point.normal, id };
  }
};

/**
 * A piece of a light as a point sees it, or a part of that: what comes towards the point if nothing
 * stands between. A light in the air is one place; on a triangle places can be chosen by solid
 * angle, or nearly by what they bring to the point, the solid angle times the cosine at the point.
 * Then parts are above the horizon of the point, and the square from which samples come is warped
 * by what is bilinear between the cosines of the corners (Hart, Pharr, Müller, Lopes, McGuire and
 * Shirley, "Practical Product Sampling by Fitting and Composing Warps", EGSR 2020).
 */
class SeenLight
{
public:
  enum class By
  {
    SolidAngle,
    Cosine
  };

  /// Appends what a point sees, up to two parts; none if all is below the horizon. The light and
  /// the piece must outlive them.
  static void addParts(const Light& light, const LampPiece& piece, const LitPoint& point, By by,
    std::vector<SeenLight>& parts);

  /// What to choose one of several parts by: the integral of LitPoint::partOf() over the solid
  /// angle, roughly; by solid angle that too, but 0 below the horizon.
  double taken() const { return meanPart_ * solidAngle(); }
  /// sr; 0 of a light in the air.
  double solidAngle() const { return seen_ ? seen_->solidAngle() : 0; }
  const LampPiece& piece() const { return *piece_; }
  /// W/m2 that come of the flux of the piece, roughly; of a light in the air exactly.
  double irradiance(const LitPoint& point) const;

  struct Sample
  {
    Ray ray;           ///< it starts clear of the place; its length is 1 at the point
    Vector3 along;     ///< from the place to the point
    double solidAngle; ///< for which the place stands: 1 over its density, sr; 0: the only one
    double per, over;  ///< sr and m2 sr; in the air 1/sr and m2

    /// Whether light may come.
    bool isLit() const { return per > 0; }
    /// W/m2 for each W of the light's flux. `part`: of the beam that the point receives.
    double perWatt(double part) const { return part * per / over; }
  };
  /// `u`: of the unit square, chooses the place.
  Sample sample(const std::array<double, 2>& u, const LitPoint& point) const;

private:
  /// A corner: the weights of the piece's corners, and where it is.
  struct Corner
  {
    Vector3 weights, place;
  };

  SeenLight() = default;
  /// A part between corners.
  SeenLight between(std::array<Corner, 3> corners, const LitPoint& point, By by) const;
  /// The weights of the piece's corners that a place of the unit square chooses, and the solid
  /// angle for which it stands.
  std::pair<Vector3, double> weightsAt(std::array<double, 2> u) const
  {
    const double mean = 0.25 * (density_[0] + 2 * density_[1] + density_[2]);
    u[1] = sampleLinear(u[1], density_[1], 0.5 * (density_[0] + density_[2]));
    const double first = (1 - u[1]) * density_[1] + u[1] * density_[0],
                 last = (1 - u[1]) * density_[1] + u[1] * density_[2];
    u[0] = sampleLinear(u[0], first, last);
    const double density = (1 - u[0]) * first + u[0] * last;
    return { weights_ * seen_->sample(u), density > 0 ? seen_->solidAngle() * mean / density : 0 };
  }

  const Light* light_ = nullptr;
  const LampPiece* piece_ = nullptr;
  std::optional<SphericalTriangle> seen_; ///< none in the air
  Matrix3 weights_;     ///< of the piece's corners; a column for each of the part's
  Vector3 density_;     ///< of samples in the part's corners, in some unit
  double meanPart_ = 0; ///< of LitPoint::partOf()
};

}
