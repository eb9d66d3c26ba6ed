// SPDX-License-Identifier: BSD-3-Clause
#include "Ellipsoids/EllipsoidBound.h"

#include "Ellipsoids/PrincipalAxes.h"

#include <Eigen/Geometry>

// Documentation/Theory.md proves that nothing is rejected, or left out of the box, wrongly. Here
// G stands for the exact matrix linear * shape^-1, and u for the unit roundoff 2^-53.

namespace irradiance
{
namespace
{

constexpr double kUnitRoundoff = 0x1p-53;
constexpr double kThinnest = 0x1p-20;         // of the longest semi-axis, see roundingMap
constexpr double kLargestRadius = 16.0;       // it is about 1
constexpr double kUnderflowLength = 0x1p-500; // pays for products that underflow

/// Bounds |shape^-1 * y - inverse * y| for |y| <= 1, divided by |inverse|; infinite if unknown.
double relativeInverseError(const Matrix3& shape, const Matrix3& inverse)
{
  // shape^-1 = (I + residual)^-1 * inverse. With `shape` as encloseByEllipsoid writes it, this
  // residual is small even for a needle; the residual of shape * inverse is not.
  const double rounding = 8.0 * kUnitRoundoff * (inverse.cwiseAbs() * shape.cwiseAbs()).norm();
  const double residual = (inverse * shape - Matrix3::Identity()).norm() + rounding;
  return residual < 0.5 ? 2.0 * residual : kInfinity;
}

/// Every point of the exact ellipsoid is center + semiAxes * y + r, |y| <= 1, |r| <= uncertainty.
struct MovedEllipsoid
{
  Vector3 center;
  Matrix3 semiAxes;   // columns, not at right angles in general
  double uncertainty; // infinite if nothing is known

  bool isKnown() const
  {
    return center.allFinite() && semiAxes.allFinite() && std::isfinite(uncertainty);
  }
};

MovedEllipsoid moved(const EnclosingEllipsoid& ellipsoid, const AffineMap& worldFromObject)
{
  const Matrix3& linear = worldFromObject.linear;
  const Matrix3 inverseShape = ellipsoid.shape.inverse();
  const double centerError = 8.0 * kUnitRoundoff *
    (linear.cwiseAbs() * ellipsoid.center.cwiseAbs() + worldFromObject.translation.cwiseAbs())
      .norm();
  const double axesError =
    (2.0 * relativeInverseError(ellipsoid.shape, inverseShape) + 8.0 * kUnitRoundoff) *
    linear.norm() * inverseShape.norm();
  return { worldFromObject(ellipsoid.center), linear * inverseShape,
    centerError + axesError + kUnderflowLength };
}

/// Lengthens axes shorter than `pad` or much shorter than the longest. Compared with the
/// pad their length does not matter, and it may be 0.
Matrix3 roundingMap(const Matrix3& matrix, double pad)
{
  const Matrix3 semiAxes = principalSemiAxes(matrix);
  const Vector3 lengths = semiAxes.colwise().norm();
  const double longest = lengths[0] + pad;
  const Vector3 usable = (lengths.array() + pad).cwiseMax(kThinnest * longest);
  Matrix3 directions = Matrix3::Identity();
  if (lengths[0] > 0.0)
  {
    directions.col(0) = semiAxes.col(0) / lengths[0];
    directions.col(1) = lengths[1] > kThinnest * kThinnest * lengths[0]
      ? Vector3(semiAxes.col(1) / lengths[1])
      : directions.col(0).unitOrthogonal();
    directions.col(2) = directions.col(0).cross(directions.col(1));
  }
  return usable.cwiseInverse().asDiagonal() * directions.transpose();
}

/// An upper bound of |G^T N| / |n| over all n, for N = W^T n as it is computed.
double radiusBound(const Matrix3& roundFromWorld, const Matrix3& semiAxes)
{
  const Matrix3 product = roundFromWorld * semiAxes;
  const Matrix3 square = product * product.transpose();
  return std::sqrt(square.cwiseAbs().rowwise().sum().maxCoeff()) * (1.0 + 16.0 * kUnitRoundoff) +
    16.0 * kUnitRoundoff * roundFromWorld.norm() * semiAxes.norm();
}

Box boxAround(const MovedEllipsoid& ellipsoid)
{
  const Vector3 rounding = 4.0 * kUnitRoundoff * ellipsoid.center.cwiseAbs();
  const Vector3 reach = (1.0 + 16.0 * kUnitRoundoff) *
      (ellipsoid.semiAxes.rowwise().norm() + Vector3::Constant(ellipsoid.uncertainty)) +
    rounding;
  return { ellipsoid.center - reach, ellipsoid.center + reach };
}

/// Of a box that is not empty.
Box boxOfModelBox(const Box& modelBox, const AffineMap& worldFromObject)
{
  const Matrix3 absolute = worldFromObject.linear.cwiseAbs();
  const Vector3 middle = modelBox.center();
  const Vector3 half = (modelBox.upper - middle).cwiseMax(middle - modelBox.lower);
  const Vector3 center = worldFromObject(middle);
  const Vector3 rounding = 16.0 * kUnitRoundoff *
    (absolute * (middle.cwiseAbs() + half) + worldFromObject.translation.cwiseAbs());
  const Vector3 reach = absolute * half + rounding;
  return { center - reach, center + reach };
}

/// Inflates by `pad` and by the rounding of this step, so that nothing within `pad` is left out.
Box padded(Box box, double pad)
{
  const Vector3 lowerRounding = 4.0 * kUnitRoundoff * box.lower.cwiseAbs();
  const Vector3 upperRounding = 4.0 * kUnitRoundoff * box.upper.cwiseAbs();
  box.lower -= lowerRounding;
  box.upper += upperRounding;
  box.inflate(pad * (1.0 + 8.0 * kUnitRoundoff));
  return box;
}

}

EllipsoidBound::EllipsoidBound(const EnclosingEllipsoid& ellipsoid, const Box& modelBox,
  const AffineMap& worldFromObject, double worldPad)
  : center_(Vector3::Zero())
  , roundFromWorld_(Matrix3::Zero()) // makes every normal 0, so that nothing is rejected
  , radiusSquared_(0.0)
  , pad_(0.0)
{
  if (modelBox.isEmpty())
  {
    return;
  }
  const MovedEllipsoid body = moved(ellipsoid, worldFromObject);
  worldBox_ = boxOfModelBox(modelBox, worldFromObject);
  if (!body.isKnown() || !std::isfinite(worldPad) || worldBox_.isEmpty())
  {
    worldBox_ = { Vector3::Constant(-kInfinity), Vector3::Constant(kInfinity) };
    return;
  }
  worldBox_ = padded(worldBox_.intersection(boxAround(body)), worldPad);

  const double pad = (worldPad + body.uncertainty) * (1.0 + 32.0 * kUnitRoundoff);
  const Matrix3 guide = roundingMap(body.semiAxes, pad);
  const double radius = radiusBound(guide, body.semiAxes);
  if (guide.allFinite() && radius < kLargestRadius)
  {
    center_ = body.center;
    roundFromWorld_ = guide;
    radiusSquared_ = radius * radius * (1.0 + 32.0 * kUnitRoundoff);
    pad_ = pad;
  }
}

}
