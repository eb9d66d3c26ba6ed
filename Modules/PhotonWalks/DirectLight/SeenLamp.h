// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SeenLamp_h
#define irradiance_SeenLamp_h

#include "DirectLight/LitPoint.h"
#include "Sampling/SphericalTriangle.h"

#include <array>
#include <vector>

namespace irradiance
{

/**
 * A triangle of a lamp as a point sees it, or a part of that, whose points can be chosen by solid
 * angle; or nearly by what they bring to the point, the solid angle times the cosine at the point.
 * Then parts are above the horizon of the point, and the square from which samples come is warped
 * by what is bilinear between the cosines of the corners (Hart, Pharr, Müller, Lopes, McGuire and
 * Shirley, "Practical Product Sampling by Fitting and Composing Warps", EGSR 2020).
 */
class SeenLamp
{
public:
  enum class By
  {
    SolidAngle,
    Cosine
  };

  /// Appends what a point sees, up to two parts; none if all is below the horizon.
  static void addParts(
    const Triangle& lamp, const LitPoint& point, By by, std::vector<SeenLamp>& parts);

  /// The integral of LitPoint::partOf() over the solid angle, roughly; by solid angle that too, but
  /// 0 below the horizon.
  double taken() const { return meanPart_ * seen_.solidAngle(); }
  double solidAngle() const { return seen_.solidAngle(); }
  struct Sample
  {
    Vector3 weights;   ///< barycentric, of the lamp
    double solidAngle; ///< for which the sample stands: 1 over its density, sr
  };
  /// `u`: of the unit square.
  Sample sample(std::array<double, 2> u) const;

private:
  /// A corner: the weights of the lamp's corners, and where it is.
  struct Corner
  {
    Vector3 weights, place;
  };

  static void add(
    std::array<Corner, 3> corners, const LitPoint& point, By by, std::vector<SeenLamp>& parts);
  /// `density`: in the corners, in some unit. `meanPart`: of LitPoint::partOf().
  SeenLamp(const std::array<Corner, 3>& corners, const Vector3& from, const Vector3& density,
    double meanPart);

  Matrix3 weights_; ///< of the lamp's corners; a column for each of the part's
  SphericalTriangle seen_;
  Vector3 density_;
  double meanPart_;
};

}

#endif
