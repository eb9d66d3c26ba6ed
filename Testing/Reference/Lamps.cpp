// SPDX-License-Identifier: BSD-3-Clause
#include "Lamps.h"

#include "Surfaces.h"

#include <algorithm>

namespace pathtracedroom
{

using namespace irradiance;

Lamps::Lamps(const SceneObjects& objects)
{
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    addTriangles(objects, object);
    addPoints(objects[object]);
  }
}

void Lamps::add(const Lamp& lamp, double flux)
{
  if (flux > 0)
  {
    lamps_.push_back(lamp);
    cumulativeFlux_.push_back(this->flux() + flux);
  }
}

void Lamps::addTriangles(const SceneObjects& objects, std::uint32_t object)
{
  const TriangleMesh& mesh = objects[object].body->mesh();
  for (std::uint32_t i = 0; i < mesh.size(); ++i)
  {
    const Spectrum exitance =
      exitanceOf(objects[object], objects[object].material->cellOfTriangle[i]);
    const Triangle triangle = transformed(objects[object].worldFromObject, mesh[i]);
    add({ { object, i }, triangle, exitance }, exitance.sum() * triangle.area());
  }
}

void Lamps::addPoints(const SceneObject& object)
{
  if (!object.emission)
  {
    return;
  }
  for (const PointSource& light : object.emission->points)
  {
    Spectrum flux = Spectrum::Zero();
    std::copy(light.flux.begin(), light.flux.end(), flux.begin());
    const Vector3 position = object.worldFromObject(light.position);
    add({ {}, { position, position, position }, flux }, flux.sum());
    pointBounds_.add(position);
  }
}

Departure Lamps::start(Random& random) const
{
  const double chosen = random.next() * flux();
  const auto after = std::upper_bound(cumulativeFlux_.begin(), cumulativeFlux_.end() - 1, chosen);
  const Lamp& lamp = lamps_[static_cast<std::size_t>(after - cumulativeFlux_.begin())];
  const std::array<double, 2> place = random.nextPair(), direction = random.nextPair();
  if (lamp.id == TriangleId{})
  {
    PathVertex vertex;
    vertex.shape = PathVertex::Shape::Sphere;
    vertex.position = vertex.clearPosition = lamp.triangle.a;
    vertex.diffuse = lamp.light;
    vertex.diffuseChance = 1;
    vertex.throughput = Spectrum::Constant(flux() / lamp.light.sum());
    return { vertex, sphereDirection(direction) };
  }
  PathVertex surface = surfaceVertex(lamp.id, surfacePoint(lamp.triangle, evenWeights(place)));
  surface.exitance = lamp.light;
  const PathVertex vertex = lampAt(surface);
  return { vertex, cosineDirection(vertex.normal, direction) };
}

/// A lamp is chosen with probability exitance x area / flux, and then a point with 1 / area.
PathVertex Lamps::lampAt(const PathVertex& vertex) const
{
  PathVertex lamp = vertex;
  lamp.diffuse = vertex.exitance;
  lamp.diffuseChance = 1;
  lamp.specularChance = 0;
  lamp.lobe = nullptr;
  lamp.density = vertex.exitance.sum() / flux();
  lamp.throughput = Spectrum::Constant(1 / lamp.density);
  return lamp;
}

}
