// SPDX-License-Identifier: BSD-3-Clause
#include "Lights/IntensityDistribution.h"

#include "Sampling/SobolPoint.h"

#include <algorithm>
#include <cmath>

namespace irradiance
{

namespace
{

/// Cosine between normals of triangles and of the face of which they are a part.
constexpr double kParallel = 1 - 4e-6;

}

/// Normals go with the inverse, so that they stay across what they were across.
IntensityDistribution::IntensityDistribution(
  const Luminaire& lamp, const AffineMap& worldFromObject, bool hasShares)
  : table_(lamp.intensity)
{
  const Matrix3& linear = worldFromObject.linear;
  const double determinant = linear.determinant();
  const Matrix3 ofNormals = std::abs(determinant) * linear.inverse().transpose();
  const Vector3 axis = (ofNormals * lamp.axis).normalized(),
                reference = (linear * lamp.reference).normalized();
  axes_ << reference, (determinant < 0 ? -1 : 1) * reference.cross(axis), axis;
  for (const Vector3& face : lamp.faces)
  {
    areas_.push_back(ofNormals * face);
  }
  shares_.assign(areas_.size(), areas_.size() == 1 ? 1 : 0);
  if (areas_.size() < 2 || !hasShares)
  {
    return;
  }
  double sum = 0;
  table_->forEachPart([&](const Vector3& local, double weight) {
    const Vector3 direction = axes_ * local;
    const double seen = seenArea(direction);
    for (std::size_t i = 0; i < areas_.size() && seen > 0; ++i)
    {
      shares_[i] += weight * std::max(0.0, areas_[i].dot(direction)) / seen;
    }
    sum += seen > 0 ? weight : 0;
  });
  for (double& share : shares_)
  {
    share = sum > 0 ? share / sum : 0;
  }
}

IntensityDistribution::Face IntensityDistribution::faceOf(const Vector3& normal) const
{
  Face face;
  for (std::size_t i = 0; i < areas_.size(); ++i)
  {
    if (areas_[i].dot(normal) >= kParallel * areas_[i].norm())
    {
      face.area += areas_[i].norm();
      face.share += shares_[i];
    }
  }
  return face;
}

/// By rejection, unless the opening is flat: then a direction in front of it is always taken.
Vector3 IntensityDistribution::sample(
  std::array<double, 2> u, const Vector3& normal, const Face& face) const
{
  constexpr int kMostTries = 1 << 16; // beyond any lamp: a face with less light has no share
  for (int i = 0; i < kMostTries; ++i)
  {
    Vector3 direction = sample(u);
    const double ofFace = face.area * normal.dot(direction);
    if (ofFace > 0)
    {
      if (areas_.size() == 1 || otherSquare(u)[0] * seenArea(direction) <= ofFace)
      {
        return direction;
      }
    }
    u = otherSquare({ u[1], u[0] });
  }
  return normal;
}

double IntensityDistribution::roughIntensity(
  const Vector3& direction, const Vector3& normal, const Face& face) const
{
  constexpr double kAlike = 0.1, kSphere = 4 * kPi; // the part that leaves to all sides alike
  const double whole = (1 - kAlike) * intensity(direction) + kAlike / kSphere;
  if (!(face.area > 0 && face.share > 0))
  {
    return whole;
  }
  constexpr double kSlack = 0.05; // of the cosine
  const double seen = face.area * (std::max(0.0, normal.dot(direction)) + kSlack);
  return whole * seen / (seenArea(direction) + kSlack * face.area) / face.share;
}

Bands emittedFrom(
  const SceneObject& object, std::size_t cell, bool isFront, const Vector3& direction)
{
  Bands emitted{};
  if (!isFront || !object.hasExitance(cell))
  {
    return emitted;
  }
  if (const Luminaire* const lamp = object.emission->luminaireOf(cell))
  {
    const double radiance =
      IntensityDistribution(*lamp, object.worldFromObject, false).radiance(direction);
    std::transform(lamp->flux.begin(), lamp->flux.end(), emitted.begin(),
      [radiance](double watts) { return kPi * radiance * watts; });
    return emitted;
  }
  const double* const exitance = object.exitanceOf(cell);
  std::copy(exitance, exitance + object.emission->bands, emitted.begin());
  return emitted;
}

}
