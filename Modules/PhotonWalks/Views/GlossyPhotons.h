// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_GlossyPhotons_h
#define irradiance_GlossyPhotons_h

#include "Meshes/SurfacePoint.h"
#include "Surfaces/PhongLobe.h"
#include "Surfaces/Power.h"
#include "Views/Eye.h"

#include <array>
#include <cstdint>
#include <vector>

namespace irradiance
{

/**
 * The photons that arrived on a cell with a lobe, made ready for many eyes: what does not depend on the
 * eye is computed once. A photon's part is its power times PhongLobe::value(); but where the lobe's
 * power of the cosine is below 2^-70 of its peak, that term is taken for 0. A billion such photons
 * together count for less than the rounding of one within the lobe.
 */
class GlossyPhotons
{
public:
  using Bands = std::array<double, Power::kMaxBands>;
  struct Arrival
  {
    std::uint32_t triangle;
    SurfacePoint point; ///< on the side where it arrived
    Vector3 toLight;    ///< unit vector
    Bands watts;
  };

  GlossyPhotons() = default;
  /// The result depends on the order of the arrivals, in the last bits.
  GlossyPhotons(const PhongLobe& lobe, std::vector<Arrival> arrivals, int bands);

  /// The sum over the photons of power times BRDF, W/sr. `lobe`: the same.
  Bands towards(const Eye& eye, const PhongLobe& lobe) const;

private:
  /// Those on one side of a triangle.
  struct Side
  {
    Vector3 normal;     ///< unit vector
    std::size_t end;    ///< of its photons
    Bands compensation; ///< the lobe's second term, W/sr, over the loss towards the eye
  };
  struct Lobe;

  /// Towards a direction: a unit vector.
  Bands towardsFar(const Vector3& direction, const PhongLobe& lobe) const;
  Bands towardsNear(const Eye& eye, const PhongLobe& lobe) const;
  void addLobe(std::size_t photon, double weight, Bands& sum) const
  {
    for (std::size_t band = 0; band < watts_.size(); ++band)
    {
      sum[band] += weight * watts_[band][photon];
    }
  }

  std::vector<Side> sides_;
  // By photon, side after side.
  std::array<std::vector<double>, 3> mirrored_; ///< where a mirror would send it, by coordinate
  std::array<std::vector<double>, 3> points_;
  std::vector<double> perCosine_;          ///< 1 / cosine of incidence
  std::vector<double> losses_;             ///< the lobe's loss there, over its mean and pi
  std::vector<std::vector<double>> watts_; ///< by band
};

}

#endif
