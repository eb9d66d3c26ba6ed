// SPDX-License-Identifier: BSD-3-Clause
#include "Photons/PlacedTree.h"

#include <Eigen/SVD>

#include <cmath>

namespace irradiance
{

Share facingShare(const SurfaceNode& node, const Vector3& direction)
{
  double least = 0, most = 1; // cosine
  if (node.cosine > 0)
  {
    const double cosine = std::abs(direction.dot(node.axis));
    const double sine = direction.cross(node.axis).norm();
    least = cosine * node.cosine - sine * node.sine;
    most = cosine >= node.cosine ? 1 : cosine * node.cosine + sine * node.sine;
  }
  // Next to the limit rounding decides, which a look at single triangles does better.
  constexpr double kRounding = 0x1p-20;
  const bool mayFace = most >= Facing::kLeastCosine - kRounding;
  const bool doFace = least >= Facing::kLeastCosine + kRounding;
  return !mayFace ? Share::None : doFace ? Share::All : Share::Some;
}

PlacedTree::PlacedTree(const SceneObject& object, double searchUnitsPerWorldUnit)
  : frame_(object.body->tree().frame())
  , surfaceFrame_(object.body->mesh().bounds())
  , worldFromObject_(object.worldFromObject)
  , inverse_(worldFromObject_.linear.inverse())
  , bounds_(object.worldBounds())
  , searchUnitsPerWorldUnit_(searchUnitsPerWorldUnit)
{
  size_ = bounds_.size();
  bounds_.inflate(
    0x1p-40 * (bounds_.magnitude() + worldFromObject_.translation.cwiseAbs().maxCoeff()));
  int exponent;
  std::frexp(worldFromObject_.linear.cwiseAbs().maxCoeff(), &exponent);
  linear_ = worldFromObject_.linear * std::ldexp(1.0, -exponent);
  stretch_ = worldFromObject_.linear / frame_.scale * searchUnitsPerWorldUnit;
  longest_ = Sensor::kFlattening * stretch_.norm();
  condition_ = worldFromObject_.linear.norm() * inverse_.norm();
  constexpr double kRounding = 1 - 0x1p-20;
  const double least = Eigen::JacobiSVD<Matrix3>(stretch_).singularValues()[2] * kRounding;
  least_ = static_cast<float>(least);
  leastWorldUnits_ = least / searchUnitsPerWorldUnit * frame_.scale / surfaceFrame_.scale;
  const Matrix3 world = worldFromObject_.linear / surfaceFrame_.scale;
  const double length = world.norm() / std::sqrt(3.0);
  turn_ = world / length;
  constexpr double kSameAngles = 0x1p-30;
  if ((turn_.transpose() * turn_ - Matrix3::Identity()).cwiseAbs().maxCoeff() < kSameAngles)
  {
    worldUnitsPerUnit_ = length;
  }
}

/// Floats: three coordinates of the photon and of the sensor, their difference, the stretch and a
/// norm are each off by a few 2^-24 of vectors that are no longer than the sensor's distance and
/// sqrt(3); a leaf's box by kStray. Doubles: the sensor's way to model space, and the photon's way
/// to the world.
LocalSensor PlacedTree::see(const Sensor& sensor) const
{
  const Vector3 unit = frame_(inverse_ * (sensor.position - worldFromObject_.translation));
  const double distance = unit.norm();
  const double floats = longest_ * (0x1p-18 + 0x1p-19 * distance);
  const double reach = longest_ * (2 + distance + frame_.scale * frame_.center.norm()) +
    Sensor::kFlattening * searchUnitsPerWorldUnit_ *
      (sensor.position.norm() + worldFromObject_.translation.norm());
  const double blur = floats + 0x1p-48 * condition_ * reach;
  return { { static_cast<float>(unit[0]), static_cast<float>(unit[1]),
             static_cast<float>(unit[2]) },
    (sensor.flattening() * stretch_).cast<float>(), static_cast<float>(blur), least_ };
}

}
