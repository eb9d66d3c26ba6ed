// SPDX-License-Identifier: BSD-3-Clause
#include "Lights/LightTable.h"

#include <algorithm>
#include <limits>

namespace irradiance
{

LightTable::LightTable(
  const SceneObjects& objects, std::uint64_t numberOfWalks, const LightWalls& walls)
{
  constexpr std::uint64_t kMostQuanta = std::uint64_t{ 1 } << 46;
  while (2 * static_cast<std::uint64_t>(quantaPerWalk_) * numberOfWalks <= kMostQuanta)
  {
    quantaPerWalk_ *= 2;
  }
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    if (objects[object].isPresent && objects[object].emits())
    {
      Distributions luminaires;
      for (const Luminaire& lamp : objects[object].emission->luminaires)
      {
        luminaires.push_back(
          std::make_shared<const IntensityDistribution>(lamp, objects[object].worldFromObject));
      }
      addAreas(objects[object], object, luminaires);
      addPoints(objects[object], object, walls, luminaires);
    }
  }
  if (objects.sky)
  {
    addSky(*objects.sky);
  }
  if (flux() < std::numeric_limits<double>::min())
  {
    lights_.clear(); // too weak for a double
  }
  setQuantaPerWalk(quantaPerWalk_);
}

void LightTable::setQuantaPerWalk(std::int64_t quanta)
{
  quantaPerWalk_ = quanta;
  powers_.clear();
  for (const Light& light : lights_)
  {
    Power& power = powers_.emplace_back();
    for (std::size_t band = 0; band < light.flux.size(); ++band)
    {
      const double share = light.flux[band] / light.totalFlux();
      power.quanta[band] = nearestQuanta(static_cast<double>(quanta) * share);
    }
  }
}

void LightTable::addAreas(
  const SceneObject& object, std::uint32_t number, const Distributions& luminaires)
{
  const TriangleMesh& mesh = object.mesh();
  const Emission& emission = *object.emission;
  for (std::uint32_t i = 0; i < mesh.size() && !emission.exitance.empty(); ++i)
  {
    const std::uint32_t cell = object.material->cellOfTriangle[i];
    if (!emission.hasExitance(cell))
    {
      continue;
    }
    AreaLight shape{ { number, i }, transformed(object.worldFromObject, mesh[i]) };
    const double area = shape.triangle.area();
    const Luminaire* const lamp = emission.luminaireOf(cell);
    double times = area;
    if (lamp)
    {
      shape.ofLuminaire = luminaires[emission.luminaireOfCell[cell]];
      shape.face = shape.ofLuminaire->faceOf(shape.triangle.areaVector().normalized());
      times = shape.face.shareOf(area);
    }
    Light light({ number, cell }, shape);
    const double* const watts = lamp ? lamp->flux.data() : emission.exitanceOf(cell);
    std::transform(watts, watts + emission.bands, light.flux.begin(),
      [times](double value) { return times * value; });
    add(light);
  }
}

void LightTable::addPoints(const SceneObject& object, std::uint32_t number, const LightWalls& walls,
  const Distributions& luminaires)
{
  const Emission& emission = *object.emission;
  for (std::size_t i = 0; i < emission.points.size(); ++i)
  {
    const PointSource& source = emission.points[i];
    Light light({ number, source.cell },
      PointLight(object.worldFromObject(source.position),
        walls.empty() ? std::vector<Wall>() : walls[number][i],
        emission.luminaireOf(source.cell) ? luminaires[emission.luminaireOfCell[source.cell]]
                                          : nullptr));
    std::copy(source.flux.begin(), source.flux.end(), light.flux.begin());
    add(light);
  }
}

void LightTable::addSky(const Sky& sky)
{
  const SceneCell none{ 0, std::numeric_limits<std::uint32_t>::max() };
  const auto addDistant = [&](const DistantLight& distant, const std::vector<double>& perExtent) {
    Light light(none, distant);
    std::transform(perExtent.begin(), perExtent.end(), light.flux.begin(),
      [&](double value) { return value * distant.extent(); });
    add(light);
  };
  if (!sky.sunIrradiance.empty())
  {
    addDistant(DistantLight::sunOf(sky), sky.sunIrradiance);
  }
  if (!sky.radiance.empty())
  {
    addDistant(DistantLight(sky), sky.bandWeights);
  }
}

void LightTable::add(const Light& light)
{
  if (light.totalFlux() > 0)
  {
    cumulative_.push_back((cumulative_.empty() ? 0.0 : cumulative_.back()) + light.totalFlux());
    lights_.push_back(light);
    if (!light.surface())
    {
      boundsInAir_.add(light.bounds());
      mayTouchWalls_ = mayTouchWalls_ || !light.distant();
    }
  }
}

}
