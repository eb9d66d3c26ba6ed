#include "EllipsoidBound.h"

#include <Eigen/Eigenvalues>

// The proof that nothing is rejected or left out wrongly is in Documentation/Theory.md. Its terms:
//   G        the exact matrix linear * shape^-1, approximated by semiAxes_
//   rho      uncertainty_: every point of the exact ellipsoid is center_ + semiAxes_ * y + r with
//            |y| <= 1 and |r| <= rho
//   eps      2^-53

namespace irradiance
{
namespace
{

constexpr double kUnitRoundoff = 0x1p-53;
constexpr double kThinnest = 1e-9; // of the longest semi-axis, for the guide only
// Far below every length there is; covers products of lengths that vanish.
constexpr double kSmallestLength = 0x1p-500;

Box allOfSpace()
{
  Box box;
  box.add(Vector3::Constant(-kInfinity));
  box.add(Vector3::Constant(kInfinity));
  return box;
}

bool isFinite(const EnclosingEllipsoid& ellipsoid)
{
  return ellipsoid.center.allFinite() && ellipsoid.shape.allFinite();
}

/// Bounds |shape^-1 * y - inverse * y| for |y| <= 1, divided by |inverse|; infinite if unknown.
double relativeInverseError(const Matrix3& shape, const Matrix3& inverse)
{
  // shape^-1 = (I + residual)^-1 * inverse. With `shape` as encloseByEllipsoid writes it, this
  // residual is small even for a needle; that of shape * inverse is not.
  const double rounding =
    8.0 * kUnitRoundoff * (inverse.cwiseAbs() * shape.cwiseAbs()).norm();
  const double residual = (inverse * shape - Matrix3::Identity()).norm() + rounding;
  return residual < 0.5 ? 2.0 * residual : kInfinity;
}

Box boxOfModelBox(const Box& modelBox, const AffineMap& worldFromObject)
{
  if (modelBox.isEmpty())
  {
    return {};
  }
  const Matrix3 absolute = worldFromObject.linear.cwiseAbs();
  const Vector3 middle = modelBox.center();
  const Vector3 half = (modelBox.upper - middle).cwiseMax(middle - modelBox.lower);
  const Vector3 center = worldFromObject(middle);
  const Vector3 rounding = 16.0 * kUnitRoundoff *
    (absolute * (middle.cwiseAbs() + half) + worldFromObject.translation.cwiseAbs());
  const Vector3 reach = absolute * half + rounding;
  return { center - reach, center + reach };
}

/// Inflates by `pad` and by the rounding of that, so that nothing within `pad` is left out.
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
  , semiAxes_(Matrix3::Zero())
  , uncertainty_(kInfinity)
  , roundFromWorld_(Matrix3::Zero()) // with this guide every normal is 0, and nothing is rejected
  , margin_(kInfinity)
{
  if (!isFinite(ellipsoid) || !worldFromObject.isFinite() || !std::isfinite(worldPad))
  {
    worldBox_ = modelBox.isEmpty() ? Box{} : allOfSpace();
    return;
  }
  const Box movedBox = boxOfModelBox(modelBox, worldFromObject);
  locate(ellipsoid, worldFromObject);
  if (std::isfinite(uncertainty_))
  {
    prepareRejection(worldPad);
    worldBox_ = padded(movedBox.intersection(boxOfEllipsoid()), worldPad);
  }
  else
  {
    worldBox_ = padded(movedBox, worldPad);
  }
}

void EllipsoidBound::locate(const EnclosingEllipsoid& ellipsoid, const AffineMap& worldFromObject)
{
  const Matrix3& linear = worldFromObject.linear;
  const Matrix3 inverseShape = ellipsoid.shape.inverse();
  center_ = worldFromObject(ellipsoid.center);
  semiAxes_ = linear * inverseShape;
  const double centerError = 8.0 * kUnitRoundoff *
    (linear.cwiseAbs() * ellipsoid.center.cwiseAbs() + worldFromObject.translation.cwiseAbs())
      .norm();
  const double inverseError = relativeInverseError(ellipsoid.shape, inverseShape);
  const double axesError =
    (2.0 * inverseError + 8.0 * kUnitRoundoff) * linear.norm() * inverseShape.norm();
  uncertainty_ = centerError + axesError + kSmallestLength;
  if (!center_.allFinite() || !semiAxes_.allFinite() || !std::isfinite(uncertainty_))
  {
    uncertainty_ = kInfinity;
  }
}

void EllipsoidBound::prepareRejection(double worldPad)
{
  // The last term pays for the rounding of |semiAxes^T N| and of the right-hand side as a whole.
  margin_ = (worldPad + uncertainty_) * (1.0 + 32.0 * kUnitRoundoff) +
    32.0 * kUnitRoundoff * semiAxes_.norm();

  // Principal directions from the eigenvectors of G G^T, lengths from G itself: the eigenvalues of
  // thin axes would have drowned.
  const double size = semiAxes_.cwiseAbs().maxCoeff() + margin_;
  const Matrix3 scaled = semiAxes_ / size;
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(scaled * scaled.transpose());
  const Matrix3 directions = solver.eigenvectors();
  const Vector3 lengths = (scaled.transpose() * directions).colwise().norm();
  const Vector3 thickened = lengths.array() + margin_ / size;
  const double thinnest = kThinnest * thickened.maxCoeff();
  const Matrix3 guide =
    thickened.cwiseMax(thinnest).cwiseInverse().asDiagonal() * directions.transpose();
  if (guide.allFinite())
  {
    roundFromWorld_ = guide;
  }
}

Box EllipsoidBound::boxOfEllipsoid() const
{
  const Vector3 rounding = 4.0 * kUnitRoundoff * center_.cwiseAbs();
  const Vector3 reach = semiAxes_.rowwise().norm() * (1.0 + 16.0 * kUnitRoundoff) + rounding +
    Vector3::Constant(uncertainty_);
  return { center_ - reach, center_ + reach };
}

}
