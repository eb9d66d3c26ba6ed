// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Lights/Light.h"
#include "Sampling/WeightChoice.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace irradiance
{

/// The lights of a frame. Every walk carries the same share of the total flux; which light it starts
/// from is sampled in proportion to flux.
class LightTable
{
public:
  LightTable() = default;
  /// Throws std::runtime_error for a light to which walls leave no side.
  LightTable(const SceneObjects& objects, std::uint64_t numberOfWalks, const LightWalls& walls = {})
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

  /// Those lights alone for which `chosen` holds, with the same quanta.
  LightTable only(const std::vector<bool>& chosen) const
  {
    LightTable some;
    for (std::size_t i = 0; i < lights_.size(); ++i)
    {
      if (chosen[i])
      {
        some.add(lights_[i]);
      }
    }
    some.setQuantaPerWalk(quantaPerWalk_);
    return some;
  }

  bool isEmpty() const { return lights_.empty(); }
  const std::vector<Light>& lights() const { return lights_; }
  /// Bounds of the lights in the air, which no triangle bounds.
  const Box& boundsInAir() const { return boundsInAir_; }
  /// Whether lights in the air depend on walls, which may move.
  bool mayTouchWalls() const { return mayTouchWalls_; }
  /// W, of all lights in all bands.
  double flux() const { return lights_.empty() ? 0 : cumulative_.back(); }
  /// Quanta with which every walk starts, in all bands together: the power of two for which all
  /// walks have 2^45 to 2^46. This leaves 2^16 times the emitted power for the cells to receive
  /// before a sum overflows.
  std::int64_t quantaPerWalk() const { return quantaPerWalk_; }
  /// Another number, >= 1.
  void setQuantaPerWalk(std::int64_t quanta)
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

  /// Quanta with which a walk from any light may start, in each band.
  Bands largestStart() const
  {
    Bands largest{};
    for (const Power& power : powers_)
    {
      for (std::size_t band = 0; band < largest.size(); ++band)
      {
        largest[band] = std::max(largest[band], static_cast<double>(power.quanta[band]));
      }
    }
    return largest;
  }

  /// The number of the light that a sample in (0, 1) chooses.
  std::size_t choose(double sample) const
  {
    return placeByWeight(cumulative_, sample * cumulative_.back());
  }
  /// W, up to and including each light: what choose() searches.
  const std::vector<double>& cumulativeFlux() const { return cumulative_; }
  const Light& operator[](std::size_t light) const { return lights_[light]; }
  /// With which walks leave a light.
  const Power& power(std::size_t light) const { return powers_[light]; }

  /// Equal tables start the same walks, bit for bit.
  friend bool operator==(const LightTable& a, const LightTable& b)
  {
    return a.quantaPerWalk_ == b.quantaPerWalk_ && a.lights_ == b.lights_;
  }

private:
  /// Of the luminaires of an object.
  using Distributions = std::vector<std::shared_ptr<const IntensityDistribution>>;
  void addAreas(const SceneObject& object, std::uint32_t number, const Distributions& luminaires)
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
  void addPoints(const SceneObject& object, std::uint32_t number, const LightWalls& walls,
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
  void addSky(const Sky& sky)
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
  void add(const Light& light)
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

  std::vector<Light> lights_;
  std::vector<double> cumulative_; ///< W, up to and including each light
  std::vector<Power> powers_;
  std::int64_t quantaPerWalk_ = 1;
  Box boundsInAir_;
  bool mayTouchWalls_ = false;
};

}
