// SPDX-License-Identifier: BSD-3-Clause
#include "Subpath.h"

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
  PathVertex& last = vertices_.back();
  const bool isFirst = vertices_.size() == 1 && firstDirection_;
  const std::optional<Vector3> direction = isFirst ? firstDirection_ : reflect(last);
  if (!direction)
  {
    return false;
  }
  directionDensity_ =
    last.isMirrored ? last.specularChance : last.directionDensity(last.toPrevious, *direction);
  if (!(directionDensity_ > 0)) // a grazing direction, by rounding
  {
    return false;
  }
  throughput_ = last.throughput / directionDensity_ *
    (last.isMirrored ? last.specular : last.passedOn(last.toPrevious, *direction));
  ray = { last.clearPosition, *direction, last.id };
  return true;
}

std::optional<Vector3> Subpath::reflect(PathVertex& vertex)
{
  const double chosen = random_.next();
  if (chosen < vertex.diffuseChance)
  {
    return cosineDirection(vertex.normal, random_.nextPair());
  }
  if (chosen < vertex.diffuseChance + vertex.specularChance)
  {
    irradiance::LobeSample sample;
    sample.lobe = random_.nextPair();
    sample.acceptance = random_.next();
    sample.compensation = random_.nextPair();
    vertex.isMirrored = vertex.lobe->isMirror();
    return vertex.lobe->sample(vertex.normal, -vertex.toPrevious, sample);
  }
  return {};
}

/// Where light is mirrored all densities are over directions around it, which a mirror keeps. The
/// same factor stands for both subpaths, and is left out.
bool Subpath::arrive(PathVertex vertex)
{
  const PathVertex& last = vertices_.back();
  vertex.toPrevious = (last.position - vertex.position).normalized();
  vertex.density = areaDensity(directionDensity_, last, vertex);
  if (!(vertex.density > 0)) // a grazing ray
  {
    return false;
  }
  vertex.throughput = throughput_;
  if (vertices_.size() > 1)
  {
    PathVertex& before = vertices_[vertices_.size() - 2];
    before.reverseDensity = last.isMirrored ? areaDensity(last.specularChance, last, before)
                                            : densityBack(last, -vertex.toPrevious, before);
  }
  vertices_.push_back(std::move(vertex));
  return true;
}

}
