// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_LightTable_h
#define irradiance_LightTable_h

#include "Lights/Light.h"
#include "Sampling/WeightChoice.h"

#include <cstdint>
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
  LightTable(
    const SceneObjects& objects, std::uint64_t numberOfWalks, const LightWalls& walls = {});

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
  void setQuantaPerWalk(std::int64_t quanta);

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
  void addAreas(const SceneObject& object, std::uint32_t number, const Distributions& luminaires);
  void addPoints(const SceneObject& object, std::uint32_t number, const LightWalls& walls,
    const Distributions& luminaires);
  void addSky(const Sky& sky);
  void add(const Light& light);

  std::vector<Light> lights_;
  std::vector<double> cumulative_; ///< W, up to and including each light
  std::vector<Power> powers_;
  std::int64_t quantaPerWalk_ = 1;
  Box boundsInAir_;
  bool mayTouchWalls_ = false;
};

}

#endif
