// SPDX-License-Identifier: BSD-3-Clause
#include "CellSensor.h"

#include "Directions.h"

#include <algorithm>
#include <stdexcept>

namespace pathtracedroom
{

using namespace irradiance;

CellSensor::CellSensor(const SceneObjects& objects, const std::vector<CellId>& cells)
  : objects_(objects)
  , cells_(cells.size())
{
  for (std::size_t bin = 0; bin < cells.size(); ++bin)
  {
    binOfCell_[cells[bin]] = bin;
  }
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    const std::vector<std::uint32_t>& cellOfTriangle = objects[object].material->cellOfTriangle;
    for (std::uint32_t i = 0; i < cellOfTriangle.size(); ++i)
    {
      if (const auto found = binOfCell_.find({ object, cellOfTriangle[i] });
          found != binOfCell_.end())
      {
        Cell& cell = cells_[found->second];
        const double before = cell.cumulativeArea.empty() ? 0 : cell.cumulativeArea.back();
        cell.triangles.push_back({ object, i });
        cell.cumulativeArea.push_back(before + worldTriangle({ object, i }).area());
      }
    }
  }
  if (std::any_of(cells_.begin(), cells_.end(), [](const Cell& cell) {
        return cell.triangles.empty() || !(cell.cumulativeArea.back() > 0);
      }))
  {
    throw std::invalid_argument("a cell without area has no irradiance");
  }
}

Triangle CellSensor::worldTriangle(const TriangleId& id) const
{
  const SceneObject& object = objects_[id.object];
  return transformed(object.worldFromObject, object.body->mesh()[id.triangle]);
}

Departure CellSensor::start(std::size_t bin, Random& random) const
{
  const Cell& cell = cells_[bin];
  const double area = random.next() * cell.cumulativeArea.back();
  const auto after =
    std::upper_bound(cell.cumulativeArea.begin(), cell.cumulativeArea.end() - 1, area);
  const TriangleId id =
    cell.triangles[static_cast<std::size_t>(after - cell.cumulativeArea.begin())];
  SurfacePoint point = surfacePoint(worldTriangle(id), evenWeights(random.nextPair()));
  point.turn(random.next() < 0.5);
  const PathVertex vertex = sensorAt(surfaceVertex(id, point), cell);
  return { vertex, cosineDirection(vertex.normal, random.nextPair()) };
}

std::optional<Sensor::Place> CellSensor::placeOf(const PathVertex& lightVertex) const
{
  if (lightVertex.isPoint())
  {
    return {};
  }
  const TriangleId& id = lightVertex.id;
  const auto found =
    binOfCell_.find({ id.object, objects_[id.object].material->cellOfTriangle[id.triangle] });
  if (found == binOfCell_.end())
  {
    return {};
  }
  return Place{ found->second, sensorAt(lightVertex, cells_[found->second]) };
}

/// Each side is chosen with probability 1/2. Irradiance is the integral of radiance times cosine, over
/// both sides, and its mean over the area: as if importance of pi / area were reflected diffusely.
PathVertex CellSensor::sensorAt(const PathVertex& vertex, const Cell& cell) const
{
  const double area = cell.cumulativeArea.back();
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
