// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Vector.h"

#include <array>
#include <cstddef>
#include <vector>

namespace irradiance
{

/// The direction in which a mirror reflects light that flies in the direction `incoming`.
inline Vector3 mirrored(const Vector3& normal, const Vector3& incoming)
{
  return incoming - 2 * incoming.dot(normal) * normal;
}

/// The part b of the light that the first term of a PhongLobe loses, over the cosine of incidence
/// and the width of the lobe, w = 1 / sqrt(n + 1), from 0 (a mirror) to 1 (n = 0).
namespace LobeLoss
{

constexpr std::size_t kNodes = 257;

/// The cosines at which at() knows the loss, from 0 to 1: closer together at both ends, where the
/// loss of narrow lobes changes.
double cosineOf(std::size_t node);

/**
 * The losses of a lobe at all nodes, with errors below 2^-12 for n up to 10,000. Interpolated in a
 * table over widths, each row of which is computed when it is first asked for. It is rounded to
 * multiples of 2^-22, so that results do not depend on the last bits of a system's library. Several
 * threads may call it.
 */
std::vector<double> at(double width);

/// The loss for a cosine in [0, 1], by quadrature.
double integral(double cosine, double width);

}

/// What chooses a direction of a PhongLobe: five numbers in (0, 1).
struct LobeSample
{
  std::array<double, 2> lobe;
  double acceptance;
  std::array<double, 2> compensation;
};

/**
 * Specular reflection around the mirror direction, for a specular reflectance of 1: a Phong lobe of
 * cos^n, reciprocal and with an albedo of 1 at every angle of incidence, up to a perfect mirror.
 *
 * With the angle alpha between the outgoing and the mirror direction, and the cosines c of incoming
 * and outgoing directions with the normal, the BRDF is
 *
 *   (n + 1) / (2 pi) cos^n(alpha) / max(c_in, c_out) + b(c_in) b(c_out) / (pi B).
 *
 * The first term is from Neumann, Neumann and Szirmay-Kalos, "Compact Metallic Reflectance Models"
 * (Eurographics 1999). It loses b(c_in), in the main what falls below the horizon. The second term
 * gives this back (Kulla and Conty, "Revisiting Physically Based Shading at Imageworks", 2017); B
 * is the mean of b over all directions, weighted by their cosine. Documentation/Theory.md, 1.1.
 */
class PhongLobe
{
public:
  /// `exponent` n >= 0; infinite for a mirror.
  explicit PhongLobe(double exponent);

  double exponent() const { return exponent_; }
  bool isMirror() const { return losses_.empty(); }

  /// The BRDF, per steradian. Unit vectors away from the surface; 0 if one is not on the side of
  /// the unit normal. Not for mirrors.
  double value(const Vector3& normal, const Vector3& toLight, const Vector3& toEye) const;

  /// The direction in which light leaves that flies in the direction `incoming`: a unit vector
  /// against the unit normal. Density: value() times the cosine of the direction, per steradian.
  Vector3 sample(const Vector3& normal, const Vector3& incoming, const LobeSample& sample) const;

  /// The part b of the light that the first term loses, for a cosine of incidence > 0.
  double loss(double cosine) const;

private:
  Vector3 compensate(const Vector3& normal, const std::array<double, 2>& sample) const;

  double exponent_;
  // By node. The loss is linear in the square of the cosine between nodes.
  std::vector<double> squares_; ///< of the cosine, from 0 to 1
  std::vector<double> losses_;
  std::vector<double> sums_; ///< the integral of the loss over the square, from 0; the last is B
};

}
