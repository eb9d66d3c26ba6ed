// SPDX-License-Identifier: BSD-3-Clause
#include "FinalGather/PathLights.h"

#include "Progress/InputError.h"

#include <algorithm>
#include <numeric>

namespace irradiance
{

std::deque<PointDirectLight> lightsOf(const WalkSets& walks, const Frame& frame, std::uint64_t seed,
  std::uint32_t samples, std::size_t mostWeights, bool gathered)
{
  std::deque<PointDirectLight> lights;
  for (const WalkSet& set : walks.sets())
  {
    const bool isAsked = gathered ? set.source().cells.has_value() : !set.source().areFoundByRays;
    // The sets of dynamic cells have the same lights.
    if (isAsked && !set.source().isDynamic() && !set.lights().isEmpty())
    {
      lights.emplace_back(
        frame, set.source().knownLamps(), seed + lights.size(), samples, mostWeights);
    }
  }
  return lights;
}

std::optional<UnseenLight> unseenLight(const SceneObjects& objects)
{
  UnseenLight unseen{};
  bool hasLight = false, hasSpecular = false;
  for (std::uint32_t i = 0; i < objects.size() && !(hasLight && hasSpecular); ++i)
  {
    const SceneObject& object = objects[i];
    if (!hasLight && object.isPresent && object.emits() && !object.emission->points.empty())
    {
      const PointSource& point = object.emission->points.front();
      hasLight = true;
      unseen.light = { i, point.cell };
      unseen.flux = std::accumulate(point.flux.begin(), point.flux.end(), 0.0);
    }
    const Material& material = *object.material;
    const bool mayReflect = !hasSpecular && !object.isEmpty() && material.isSpecular();
    for (std::size_t cell = 0; mayReflect && !hasSpecular && cell < material.numberOfCells; ++cell)
    {
      if (material.isSpecular(cell))
      {
        const auto first =
          material.specularReflectance.begin() + static_cast<std::ptrdiff_t>(cell) * material.bands;
        hasSpecular = true;
        unseen.specular = { i, cell };
        unseen.reflectance = *std::max_element(first, first + material.bands);
      }
    }
  }
  return hasLight && hasSpecular ? std::optional(unseen) : std::nullopt;
}

std::string UnseenLight::message(
  const std::string& gather, const std::string& lightName, const std::string& specularName) const
{
  return lightName + ": a point light of " + text(flux) + " W, and " + specularName +
    " has the specular reflectance " + text(reflectance) + ": " + gather +
    " does not know how specular cells reflect the light of points: make them area "
    "lights, or choose another method";
}

void checkLights(const SceneObjects& objects, const std::string& gather)
{
  const auto nameOf = [](const SceneCell& cell) {
    return "object " + std::to_string(cell.object) + ", cell " + std::to_string(cell.cell);
  };
  if (const std::optional<UnseenLight> unseen = unseenLight(objects))
  {
    throw InputError(unseen->message(gather, nameOf(unseen->light), nameOf(unseen->specular)));
  }
}

}
