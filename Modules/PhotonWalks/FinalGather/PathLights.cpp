// SPDX-License-Identifier: BSD-3-Clause
#include "FinalGather/PathLights.h"

#include "Progress/InputError.h"

#include <algorithm>
#include <numeric>

namespace irradiance
{

namespace
{

/// The power heuristic: the weight of a sample of one density beside those of another, > 0.
double weightBeside(double density, double other)
{
  const double ratio = other / density;
  return 1 / (1 + ratio * ratio);
}

}

std::deque<PointDirectLight> lightsOf(const WalkSets& walks, const Frame& frame, std::uint64_t seed,
  std::uint32_t samples, Asked which, std::size_t mostWeights)
{
  std::deque<PointDirectLight> lights;
  for (const WalkSet& set : walks.sets())
  {
    const WalkSource& source = set.source();
    const bool isAsked = which == Asked::Gathered
      ? source.cells.has_value()
      : !source.areFoundByRays || (which == Asked::All && source.isSky());
    // The sets of dynamic cells have the same lights.
    if (isAsked && !set.source().isDynamic() && !set.lights().isEmpty())
    {
      lights.emplace_back(
        frame, set.source().knownLamps(), seed + lights.size(), samples, mostWeights);
    }
  }
  return lights;
}

std::string numbersOf(const SceneCell& cell)
{
  return "object " + std::to_string(cell.object) + ", cell " + std::to_string(cell.cell);
}

std::string unseenLight(const SceneObjects& objects, const std::string& gather,
  const std::function<std::string(const SceneCell&)>& nameOf)
{
  std::string light = objects.sky ? "there is a sky" : "", specular; // the first ones
  for (std::uint32_t i = 0; i < objects.size() && (light.empty() || specular.empty()); ++i)
  {
    const SceneObject& object = objects[i];
    if (light.empty() && object.isPresent && object.emits() && !object.emission->points.empty())
    {
      const PointSource& point = object.emission->points.front();
      light = nameOf({ i, point.cell }) + ": a point light of " +
        text(std::accumulate(point.flux.begin(), point.flux.end(), 0.0)) + " W";
    }
    const Material& material = *object.material;
    const bool mayReflect = !object.isEmpty() && material.isSpecular();
    for (std::size_t cell = 0; mayReflect && specular.empty() && cell < material.numberOfCells;
         ++cell)
    {
      if (material.isSpecular(cell))
      {
        const auto first =
          material.specularReflectance.begin() + static_cast<std::ptrdiff_t>(cell) * material.bands;
        specular = nameOf({ i, cell }) + " has the specular reflectance " +
          text(*std::max_element(first, first + material.bands));
      }
    }
  }
  return light.empty() || specular.empty() ? std::string()
                                           : light + ", and " + specular + ": " + gather +
      " does not know how specular cells reflect the light of points, or of a sky: make "
      "points area lights, or choose another method";
}

void checkLights(const SceneObjects& objects, const std::string& gather,
  const std::function<std::string(const SceneCell&)>& nameOf)
{
  if (const std::string unseen = unseenLight(objects, gather, nameOf); !unseen.empty())
  {
    throw InputError(unseen);
  }
}

Bands lobeLight(const FinalGatherScene& scene, const PathVertex& from, const PhongLobe& lobe,
  std::uint64_t number, std::uint32_t share)
{
  const Vector3& normal = from.point.normal;
  const PointDirectLight::Part part = [&](const Vector3& along, double density) {
    const Vector3 toLight = -along.normalized();
    const double ofLobe = lobe.value(normal, toLight, -from.incoming) * toLight.dot(normal);
    return ofLobe > 0 ? kPi * ofLobe * weightBeside(density, ofLobe) : 0;
  };
  Bands sum{};
  for (const PointDirectLight& lights : scene.lights)
  {
    sum += lights.taken(from.point, part, number, share);
  }
  return sum;
}

double lampWeight(const FinalGatherScene& scene, const Ray& ray, double density,
  const TriangleId& lamp, const Vector3& place)
{
  const Vector3 front = scene.frame.scene.worldTriangle(ray.start).areaVector().normalized();
  const Vector3 normal = front.dot(ray.direction) > 0 ? front : Vector3(-front);
  double asked = 0;
  for (const PointDirectLight& lights : scene.lights)
  {
    asked += lights.density({ ray.origin, normal, ray.start }, lamp, place);
  }
  return asked > 0 ? weightBeside(density, asked) : 1;
}

}
