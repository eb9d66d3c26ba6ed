// SPDX-License-Identifier: BSD-3-Clause
#include "PathVertex.h"

#include <algorithm>
#include <cmath>

namespace pathtracedroom
{

double PathVertex::spread(const Vector3& to) const
{
  const double cosine = normal.dot(to);
  switch (shape)
  {
    case Shape::Sphere:
      return 1 / (4 * M_PI);
    case Shape::Pixel:
      return cosine > 0 ? 1 / (cosine * cosine * cosine) : 0;
    default:
      return std::max(cosine, 0.0) / M_PI;
  }
}

double PathVertex::gloss(const Vector3& from, const Vector3& to) const
{
  return lobe && !lobe->isMirror() ? lobe->value(normal, from, to) * std::max(normal.dot(to), 0.0)
                                   : 0;
}

Spectrum PathVertex::passedOn(const Vector3& from, const Vector3& to) const
{
  return diffuse * spread(to) + specular * gloss(from, to);
}

double PathVertex::directionDensity(const Vector3& from, const Vector3& to) const
{
  return diffuseChance * spread(to) + specularChance * gloss(from, to);
}

PathVertex surfaceVertex(const TriangleId& id, const irradiance::SurfacePoint& point)
{
  PathVertex vertex;
  vertex.id = id;
  vertex.position = point.position;
  vertex.clearPosition = point.clearPosition();
  vertex.normal = point.normal;
  return vertex;
}

double areaDensity(double directionDensity, const PathVertex& vertex, const PathVertex& next)
{
  if (next.isPoint())
  {
    return 0;
  }
  const Vector3 edge = next.position - vertex.position;
  const double square = edge.squaredNorm();
  return directionDensity * std::abs(next.normal.dot(edge)) / (square * std::sqrt(square));
}

}
