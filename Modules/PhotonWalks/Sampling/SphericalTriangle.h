// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Triangle.h"
#include "Sampling/ElementaryFunctions.h"

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
  SphericalTriangle(const Triangle& triangle, const Vector3& from)
  {
    a_ = triangle.a - from;
    b_ = triangle.b - from;
    Vector3 c = triangle.c - from;
    const double scale = scaleToOne(a_, b_, c);
    a_ *= scale;
    b_ *= scale;
    c *= scale;
    // Of the corners themselves: from afar, differences of a_, b_ and c are less exact.
    toB_ = scale * (triangle.b - triangle.a);
    toC_ = scale * (triangle.c - triangle.a);
    squareA_ = a_.squaredNorm();
    squareB_ = b_.squaredNorm();
    const Vector3 crossB = a_.cross(toB_), crossC = a_.cross(toC_);
    const double squareCrossC = crossC.squaredNorm();
    crossC_ = std::sqrt(squareCrossC);
    const double a = std::sqrt(squareA_), ab = a * std::sqrt(squareB_), ac = a * c.norm();
    const double halfB = onePlusCosine(ab, a_.dot(b_), crossB.squaredNorm());
    const double halfC = onePlusCosine(ac, a_.dot(c), squareCrossC);
    sine_ = a * std::abs(a_.dot(toB_.cross(toC_)));
    cosine_ = crossB.dot(crossC);
    cotangent_ = halfB * crossC_;
    // Of a spherical triangle with excess E, angle A, and sides b and c that meet there:
    // cot(E / 2) = (cot(b / 2) cot(c / 2) + cos A) / sin A (Todhunter, Spherical Trigonometry, 1886).
    const bool isSeen = sine_ > 0 && ab * ac > 0; // not from a corner
    halfTurns_ = isSeen ? arcTangent(sine_, halfB * halfC + cosine_) * 0.15915494309189535 : 0;
  }

  /// In sr, in [0, 2 pi]; 0 if it is seen edge-on or from a corner, or has no area.
  double solidAngle() const { return 12.566370614359172 * halfTurns_; }
  /**
   * The barycentric weights, >= 0 and of sum 1 but for rounding, of the point in the direction that
   * a point of the unit square chooses evenly by solid angle; by area if the solid angle is 0.
   * Continuous in u, so that points of low discrepancy stay so.
   */
  Vector3 sample(const std::array<double, 2>& u) const
  {
    // A point of the edge from a to c, and one of the cut from b to there.
    double t = u[0], s = std::sqrt(u[1]);
    if (halfTurns_ > 0)
    {
      // The cut leaves a share u[0] of the excess, by the same formula: tan(side / 2) = p / q.
      const SinCos excess(u[0] * halfTurns_);
      const double p = cotangent_ * excess.sine;
      const double q = std::max(0.0, sine_ * excess.cosine - cosine_ * excess.sine);
      t = shareOfEdge(squareA_, a_.dot(toC_), crossC_, 2 * p * q, (q - p) * (q + p));
      // Along the cut, the cosine of the angle from b is even between those of its ends: heights on a
      // sphere are (Archimedes).
      const Vector3 cut = t * toC_ - toB_, end = b_ + cut;
      const double squareCross = b_.cross(cut).squaredNorm();
      const double product = std::sqrt(squareB_ * end.squaredNorm());
      const double fall = u[1] * onePlusCosine(product, -b_.dot(end), squareCross) / product;
      const double sine = std::sqrt(fall * std::max(0.0, 2 - fall));
      s = shareOfEdge(squareB_, b_.dot(cut), std::sqrt(squareCross), sine, 1 - fall);
    }
    return { s * (1 - t), 1 - s, s * t };
  }

private:
  /// The power of two that takes the largest of the coordinates into [1, 2).
  static double scaleToOne(const Vector3& a, const Vector3& b, const Vector3& c)
  {
    const double largest = a.cwiseAbs().cwiseMax(b.cwiseAbs()).cwiseMax(c.cwiseAbs()).maxCoeff();
    const std::uint64_t exponent = bitCast<std::uint64_t>(largest) >> 52;
    return bitCast<double>((2046 - std::min<std::uint64_t>(exponent, 2045)) << 52);
  }
  /// |v| |w| (1 + cos) of two vectors by |v| |w|, v . w and |v x w|^2, without cancellation. This over
  /// |v x w| is the cotangent of half their angle.
  static double onePlusCosine(double product, double dot, double squareCross)
  {
    return dot < 0 ? squareCross / (product - dot) : product + dot;
  }
  /// How much of an edge is seen before an angle from its start; the edge's dot and cross product are
  /// those of its start and itself; sine and cosine may be multiplied by the same number.
  static double shareOfEdge(
    double squareStart, double dot, double cross, double sine, double cosine)
  {
    const double share = squareStart * sine, whole = cross * cosine - dot * sine;
    return share < whole ? share / whole : 1;
  }
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
