// SPDX-License-Identifier: BSD-3-Clause
#include "CellRadiance.h"

#include "Surfaces.h"

namespace pathtracedroom
{

Departure CellRadiance::start(std::size_t bin, Random& random) const
{
  CellPoints::Point point = points_.choose(bin, random);
  const Vector3 toEye = eye_ - point.surface.position;
  point.surface.turn(point.surface.normal.dot(toEye) > 0);
  return { sensorAt(vertexOn(objects_, point.id, point.surface), bin), {} };
}

/// Only on the side that the eye sees.
std::optional<Sensor::Place> CellRadiance::placeOf(const PathVertex& lightVertex) const
{
  const std::optional<std::size_t> bin = points_.cellOf(lightVertex);
  return bin && lightVertex.normal.dot(eye_ - lightVertex.position) > 0
    ? std::optional<Place>({ *bin, sensorAt(lightVertex, *bin) })
    : std::nullopt;
}

/// A subpath that comes from the eye to a point chosen evenly, and that no absorption has weakened.
PathVertex CellRadiance::sensorAt(const PathVertex& vertex, std::size_t bin) const
{
  PathVertex sensor = vertex;
  sensor.toPrevious = (eye_ - vertex.position).normalized();
  sensor.density = 1 / points_.area(bin);
  sensor.throughput = Spectrum::Ones();
  return sensor;
}

}
