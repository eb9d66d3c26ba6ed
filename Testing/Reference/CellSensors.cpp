// SPDX-License-Identifier: BSD-3-Clause
#include "CellSensors.h"

#include "Surfaces.h"

#include <algorithm>
#include <stdexcept>

namespace pathtracedroom
{

using namespace irradiance;

CellPoints::CellPoints(const SceneObjects& objects, const std::vector<CellId>& cells)
  : objects_(objects)
  , cells_(cells.size())
{
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    numbers_[cells[i]] = i;
  }
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    const std::vector<std::uint32_t>& cellOfTriangle = objects[object].material->cellOfTriangle;
    for (std::uint32_t i = 0; i < cellOfTriangle.size(); ++i)
    {
      if (const auto found = numbers_.find({ object, cellOfTriangle[i] }); found != numbers_.end())
      {
        Cell& cell = cells_[found->second];
        const double before = cell.cumulativeArea.empty() ? 0 : cell.cumulativeArea.back();
        cell.triangles.push_back({ object, i });
        cell.cumulativeArea.push_back(before + worldTriangle({ object, i }).area());
      }
    }
  }
  const auto isEmpty = [](const Cell& cell) {
    return cell.triangles.empty() || !(cell.cumulativeArea.back() > 0);
  };
  if (std::any_of(cells_.begin(), cells_.end(), isEmpty))
  {
    throw std::invalid_argument("nothing can be measured on a cell without area");
  }
}

Triangle CellPoints::worldTriangle(const TriangleId& id) const
{
  const SceneObject& object = objects_[id.object];
  return transformed(object.worldFromObject, object.body->mesh()[id.triangle]);
}

CellPoints::Point CellPoints::choose(std::size_t number, Random& random) const
{
  const Cell& cell = cells_[number];
  const double area = random.next() * cell.cumulativeArea.back();
  const auto after =
    std::upper_bound(cell.cumulativeArea.begin(), cell.cumulativeArea.end() - 1, area);
  const TriangleId id =
    cell.triangles[static_cast<std::size_t>(after - cell.cumulativeArea.begin())];
  return { id, surfacePoint(worldTriangle(id), evenWeights(random.nextPair())) };
}

std::optional<std::size_t> CellPoints::cellOf(const PathVertex& vertex) const
{
  if (vertex.isPoint())
  {
    return {};
  }
  const auto& cellOfTriangle = objects_[vertex.id.object].material->cellOfTriangle;
  const auto found = numbers_.find({ vertex.id.object, cellOfTriangle[vertex.id.triangle] });
  return found == numbers_.end() ? std::nullopt : std::optional<std::size_t>(found->second);
}

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
