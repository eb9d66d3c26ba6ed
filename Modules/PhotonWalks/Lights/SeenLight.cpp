// SPDX-License-Identifier: BSD-3-Clause
#include "Lights/SeenLight.h"

#include <algorithm>

namespace irradiance
{

Vector3 weightsInPlane(const Triangle& triangle, const Vector3& place)
{
  const Vector3 areaVector = triangle.areaVector();
  const double area = areaVector.stableNorm();
  const Vector3 normal = areaVector / area;
  const auto share = [&](const Vector3& from, const Vector3& to) {
    return normal.dot((to - from).cross(place - from)) / area;
  };
  const double b = share(triangle.c, triangle.a), c = share(triangle.a, triangle.b);
  return { 1 - b - c, b, c };
}

void SeenLight::addParts(const Light& light, const LampPiece& piece, const LitPoint& point, By by,
  std::vector<SeenLight>& parts)
{
  SeenLight whole;
  whole.light_ = &light;
  whole.piece_ = &piece;
  if (!light.surface())
  {
    parts.push_back(whole);
    return;
  }
  const Triangle& lamp = piece.triangle;
  const std::array<Corner, 3> corners{ { { Vector3::UnitX(), lamp.a }, { Vector3::UnitY(), lamp.b },
    { Vector3::UnitZ(), lamp.c } } };
  if (by == By::SolidAngle || !point.hasNormal())
  {
    parts.push_back(whole.between(corners, point, by));
    return;
  }
  // Along the edges, the corners above the horizon, and where an edge crosses it.
  std::array<Corner, 4> above;
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Corner &from = corners[i], &to = corners[(i + 1) % 3];
    const double height = point.normal.dot(from.place - point.position);
    const double next = point.normal.dot(to.place - point.position);
    if (height > 0)
    {
      above[count++] = from;
    }
    if ((height > 0) != (next > 0))
    {
      const double t = height / (height - next);
      above[count++] = { (1 - t) * from.weights + t * to.weights,
        (1 - t) * from.place + t * to.place };
    }
  }
  for (std::size_t i = 2; i < count; ++i)
  {
    parts.push_back(whole.between({ above[0], above[i - 1], above[i] }, point, by));
  }
}

SeenLight SeenLight::between(std::array<Corner, 3> corners, const LitPoint& point, By by) const
{
  const auto partOf = [&](const Vector3& place) {
    return std::max(0.0, point.partOf(point.position - place));
  };
  Vector3 cosines(partOf(corners[0].place), partOf(corners[1].place), partOf(corners[2].place));
  const Vector3 middle = (corners[0].place + corners[1].place + corners[2].place) / 3;
  const double meanPart = (cosines.sum() + 3 * partOf(middle)) / 6;
  const bool isWarped = by == By::Cosine && point.hasNormal() && cosines.maxCoeff() > 0;
  if (isWarped)
  {
    // Towards the second corner samples are densest in the square: it is the one with the largest
    // cosine.
    Eigen::Index largest = 0;
    cosines.maxCoeff(&largest);
    std::rotate(corners.begin(), corners.begin() + (largest + 2) % 3, corners.end());
    cosines = Vector3(cosines[(largest + 2) % 3], cosines[largest], cosines[(largest + 1) % 3]);
  }
  SeenLight part = *this;
  part.seen_.emplace(
    Triangle{ corners[0].place, corners[1].place, corners[2].place }, point.position);
  part.weights_ << corners[0].weights, corners[1].weights, corners[2].weights;
  part.density_ = isWarped ? cosines : Vector3(Vector3::Ones());
  part.meanPart_ = meanPart;
  return part;
}

double SeenLight::irradiance(const LitPoint& point) const
{
  if (piece_->part)
  {
    const double part = point.partOf(-piece_->part->middle) + piece_->part->radius;
    return piece_->flux / piece_->crossSection * std::clamp(part, 0.0, 1.0);
  }
  if (!seen_)
  {
    const double part = point.partOf(point.position - piece_->center);
    return part > 0 ? piece_->flux * sample({}, point).perWatt(part) : 0;
  }
  const Vector3 along = point.position - piece_->center;
  const double leaving = piece_->normal.dot(along);
  if (!(leaving > 0))
  {
    return 0;
  }
  const double alike = piece_->flux * taken() / AreaLight::etendue(piece_->triangle);
  return piece_->distribution ? alike * kPi *
      piece_->distribution->roughIntensity(along.normalized(), piece_->normal, piece_->face) *
      along.norm() / leaving
                              : alike;
}

SeenLight::Sample SeenLight::sample(const std::array<double, 2>& u, const LitPoint& point) const
{
  if (const DistantLight* const distant = light_->distant())
  {
    const DistantLight::Sample sky = distant->sample(*piece_->part, u);
    const Vector3 from = distant->entry(point.position, sky.direction);
    return { { from, point.position - from, {} }, -sky.direction, sky.solidAngle, sky.perWatt, 1 };
  }
  const auto [weights, solidAngle] = seen_ ? weightsAt(u) : std::pair(Vector3::UnitX().eval(), 0.0);
  const LightPlace place = light_->place(weights, &piece_->triangle);
  const Vector3 origin = place.origin(), along = point.position - place.position();
  Sample sample{ { origin, point.position - origin, light_->triangle() }, along, solidAngle, 0, 1 };
  if (seen_ && place.isInFront(point.position))
  {
    sample.per = solidAngle * piece_->share * place.relativeRadiance(point.position);
    sample.over = AreaLight::etendue(piece_->triangle);
  }
  else if (const double square = along.squaredNorm(); !seen_ && square > 0)
  {
    sample.per = place.inAir->density(along);
    sample.over = square;
  }
  return sample;
}

}
