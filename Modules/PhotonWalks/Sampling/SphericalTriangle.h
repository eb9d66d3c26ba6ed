// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SphericalTriangle_h
#define irradiance_SphericalTriangle_h

#include "Geometry/Triangle.h"

#include <array>

namespace irradiance
{

/**
 * A triangle as seen from a place: the spherical triangle onto which it projects, whose points can
 * be chosen evenly by solid angle (Arvo, "Stratified Sampling of Spherical Triangles", SIGGRAPH
 * 1995). Both windings are the same to it.
 *
 * Arvo's angles are here half-angle tangents, which are quotients of products of the corners. So
 * nothing cancels where the triangle is tiny or far, and a small one is chosen from evenly by area
 * without a case of its own. Like SinCos it has the same bits on all systems, and those of a scene
 * scaled by 2^k are the same. Lengths are 0 or within 1e-150 to 1e150 m.
 */
class SphericalTriangle
{
public:
  SphericalTriangle(const Triangle& triangle, const Vector3& from);

  /// In sr, in [0, 2 pi]; 0 if it is seen edge-on or from a corner, or has no area.
  double solidAngle() const { return 12.566370614359172 * halfTurns_; }
  /**
   * The barycentric weights, >= 0 and of sum 1 but for rounding, of the point in the direction that
   * a point of the unit square chooses evenly by solid angle; by area if the solid angle is 0.
   * Continuous in u, so that points of low discrepancy stay so.
   */
  Vector3 sample(const std::array<double, 2>& u) const;

private:
  // As seen from the place, times the power of two that makes the largest coordinate 1 to 2.
  Vector3 a_, b_;     ///< corners
  Vector3 toB_, toC_; ///< edges from corner a
  double squareA_, squareB_;
  double crossC_;        ///< |a x toC|; the angle at a lies between a x toB and a x toC
  double sine_, cosine_; ///< of that angle, times |a x toB| |a x toC|
  double cotangent_;     ///< of half the side from a to b, times |a x toB| |a x toC|
  double halfTurns_;     ///< half the solid angle, in turns
};

}

#endif
