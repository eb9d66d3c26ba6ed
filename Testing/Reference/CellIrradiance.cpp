// SPDX-License-Identifier: BSD-3-Clause
#include "CellIrradiance.h"

#include "Directions.h"

namespace pathtracedroom
{

Departure CellIrradiance::start(std::size_t bin, Random& random) const
{
  CellPoints::Point point = points_.choose(bin, random);
  point.surface.turn(random.next() < 0.5);
  const PathVertex vertex = sensorAt(surfaceVertex(point.id, point.surface), bin);
  return { vertex, cosineDirection(vertex.normal, random.nextPair()) };
}

std::optional<Sensor::Place> CellIrradiance::placeOf(const PathVertex& lightVertex) const
{
  const std::optional<std::size_t> bin = points_.cellOf(lightVertex);
  return bin ? std::optional<Place>({ *bin, sensorAt(lightVertex, *bin) }) : std::nullopt;
}

/// Each side is chosen with probability 1/2. Irradiance is the integral of radiance times cosine,
/// over both sides, and its mean over the area: as if importance of pi / area were reflected
/// diffusely.
PathVertex CellIrradiance::sensorAt(const PathVertex& vertex, std::size_t bin) const
{
  const double area = points_.area(bin);
  PathVertex sensor = vertex;
  sensor.diffuse = Spectrum::Constant(M_PI / area);
  sensor.diffuseChance = 1;
  sensor.specularChance = 0;
  sensor.lobe = nullptr;
  sensor.density = 1 / (2 * area);
  sensor.throughput = Spectrum::Constant(2 * area);
  return sensor;
}

}
