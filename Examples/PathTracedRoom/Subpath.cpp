// SPDX-License-Identifier: BSD-3-Clause
#include "Subpath.h"

#include "Directions.h"

#include <cmath>
#include <utility>

namespace pathtracedroom
{

void Subpath::begin(const Departure& departure, const Random& random)
{
  vertices_.assign(1, departure.vertex);
  random_ = random;
  firstDirection_ = departure.direction;
}

bool Subpath::leave(irradiance::Ray& ray)
{
  const PathVertex& last = vertices_.back();
  if (vertices_.size() > 1 && !(random_.next() < last.diffuseChance))
  {
    return false;
  }
  const Vector3 direction =
    vertices_.size() == 1 ? firstDirection_ : cosineDirection(last.normal, random_.nextPair());
  directionDensity_ = last.directionDensity(last.toPrevious, direction);
  if (!(directionDensity_ > 0)) // a grazing direction, by rounding
  {
    return false;
  }
  throughput_ = last.throughput * last.passedOn(last.toPrevious, direction) / directionDensity_;
  ray = { last.clearPosition, direction, last.id };
  return true;
}

bool Subpath::arrive(PathVertex vertex)
{
  const PathVertex& last = vertices_.back();
  const Vector3 edge = last.position - vertex.position;
  const double length = edge.norm();
  vertex.toPrevious = edge / length;
  vertex.density =
    directionDensity_ * std::abs(vertex.normal.dot(vertex.toPrevious)) / (length * length);
  if (!(vertex.density > 0)) // a grazing ray
  {
    return false;
  }
  vertex.throughput = throughput_;
  if (vertices_.size() > 1)
  {
    PathVertex& beforeLast = vertices_[vertices_.size() - 2];
    beforeLast.reverseDensity = areaDensity(last, -vertex.toPrevious, beforeLast);
  }
  vertices_.push_back(std::move(vertex));
  return true;
}

}
