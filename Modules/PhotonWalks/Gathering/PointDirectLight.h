// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PointDirectLight_h
#define irradiance_PointDirectLight_h

#include "Gathering/GatherSpace.h"
#include "Gathering/PointLampChoice.h"

#include <array>
#include <vector>

namespace irradiance
{

/**
 * The light that comes straight from the lights of a table to single points, on surfaces or in the air: the value
 * at the point, no mean over a cell. It is the irradiance, or of a point that receives from all directions the
 * fluence rate.
 *
 * Each sample asks a light that PointLampChoice chooses, at a point chosen by solid angle; so none brings much more
 * than others, however near a light is. Of a light in the same place as the face on which the point stands, what it emits
 * there arrives; of a point light at the very point nothing, though it would be infinite. All
 * is a pure function of the scene, the seed, the point and its number. Theory.md, 1.3.
 */
class PointDirectLight
{
public:
  using Bands = std::array<double, Power::kMaxBands>;

  /// What the arguments refer to must outlive it. `samples`: for each point; best a power of two.
  PointDirectLight(const GatherSpace& space, const LightTable& lights, std::uint64_t seed,
    std::uint32_t samples = 64);
  PointDirectLight(const PointDirectLight&) = delete;
  PointDirectLight& operator=(const PointDirectLight&) = delete;

  /// W/m2. `number`: of the point; it chooses the samples. May be called by several threads.
  Bands irradiance(const LitPoint& point, std::uint64_t number) const;
  /// Adds W/m2 that together are those: to each replicate what its block of the samples finds. There are as many
  /// samples in each.
  void add(const LitPoint& point, std::uint64_t number, std::vector<Bands>& replicates) const;

private:
  /// Light on its way to a point.
  struct Arrival
  {
    Ray ray; ///< its length is 1 at the point
    std::uint32_t light;
    double perWatt; ///< W/m2 for each W of the light's flux if nothing stands between
    std::size_t replicate = 0;
  };

  std::vector<std::uint32_t> lightsAt(const LitPoint& point) const;
  /// What the lights emit that coincide with the point.
  void addTouching(const LitPoint& point, const std::vector<std::uint32_t>& lights,
    std::size_t replicates, std::vector<Arrival>& arrivals) const;
  void addSamples(const LitPoint& point, std::uint64_t number,
    const std::vector<std::uint32_t>& touching, std::size_t replicates,
    std::vector<Arrival>& arrivals) const;
  /// `seen`: its triangle.
  Arrival from(const LampPiece& lamp, const SphericalTriangle& seen, const LitPoint& point,
    const std::array<double, 2>& onLamp) const;
  bool arrives(const Arrival& arrival, const LitPoint& point, const Hit& closest) const;

  GatherSpace space_;
  LampPieces lamps_;
  std::uint64_t seed_;
  std::uint32_t samples_;
};

}

#endif
