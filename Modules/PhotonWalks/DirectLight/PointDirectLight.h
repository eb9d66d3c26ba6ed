// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "DirectLight/LampChoice.h"
#include "Lights/SeenLight.h"
#include "Surfaces/ClearSheets.h"

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

namespace irradiance
{

inline std::array<float, 3> inFloats(const Vector3& v)
{
  return { static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()) };
}

/// A ray from a light to a point, as it was cast: what tells whether a motion may change what it
/// found.
struct ShadowRay
{
  std::array<float, 3> from;
  std::array<float, 3> to;        ///< what stops it, or else the point
  std::uint32_t triangle;         ///< the number of what stops it, or SceneTriangles::kNone
  std::uint32_t passed : 25;      ///< the part of its light that arrives, in units of 2^-24
  std::uint32_t touchesMover : 1; ///< what it meets at an end, or passes, depends on what can move
};

/**
 * The light that comes straight from the lights of a table to single points, on surfaces or in the
 * air: the value at the point, no mean over a cell. It is the irradiance, or of a point that
 * receives from all directions the fluence rate.
 *
 * Each sample asks a light that PointLampChoice chooses, at a point chosen nearly by what it would
 * bring; so none brings much more than others, however near a light is, and none is below the
 * horizon. Of a light in the same place as the face on which the point stands, what it emits there
 * arrives; of a point light at the very point nothing, though it would be infinite. All is a pure
 * function of the scene, the seed, the point and its number. Theory.md, 1.3.
 */
class PointDirectLight
{
public:
  /// What the arguments refer to must outlive it. `samples`: for each point; best a power of two.
  /// `mostWeights`: see LampChoice.
  PointDirectLight(const Frame& frame, std::shared_ptr<const LampPieces> lamps, std::uint64_t seed,
    std::uint32_t samples = 64, std::size_t mostWeights = LampChoice::kMostOfPoint);
  PointDirectLight(const PointDirectLight&) = delete;
  PointDirectLight& operator=(const PointDirectLight&) = delete;

  /// W/m2. `number`: of the point; it chooses the samples. `rays`: all rays are appended; null: not
  /// asked for. May be called by several threads.
  Bands irradiance(
    const LitPoint& point, std::uint64_t number, std::vector<ShadowRay>* rays = nullptr) const;

  /// Adds W/m2 that together are those: to each replicate what its block of the samples finds.
  /// There are as many samples in each. Of a point in the air; cast are only rays of those given
  /// that something may have changed since, of the same point in a scene with the same lights. None
  /// given: all are cast. Returns how many were cast.
  using MayChange = std::function<bool(const ShadowRay&)>;
  std::int64_t update(const LitPoint& point, std::uint64_t number, const MayChange& mayChange,
    std::vector<ShadowRay>& rays, std::vector<Bands>& replicates) const;

  /// How much a point takes of a beam along a vector, in place of the cosine. `density`: of the
  /// samples that the point takes from there, 1/sr; infinite for a light in the air.
  using Part = std::function<double(const Vector3& along, double density)>;
  /// W/m2 that a point takes, without lights in the same place as its face, or behind sheets.
  /// `number` and `share` choose the samples: those of all shares of a number are spread evenly together.
  Bands taken(
    const LitPoint& point, const Part& part, std::uint64_t number, std::uint32_t share) const;
  /// Of the samples of taken(), 1/sr, towards a place on a lamp; 0 if it is none of these lights,
  /// or is in the same place as the point's face.
  double density(const LitPoint& point, const TriangleId& lamp, const Vector3& place) const;

  const LightTable& lights() const { return lamps_->lights(); }

private:
  /// Light on its way to a point.
  struct Arrival
  {
    Ray ray; ///< its length is 1 at the point
    std::uint32_t light;
    double perWatt; ///< W/m2 for each W of the light's flux if nothing stands between
    std::size_t replicate;
  };

  /// Those that coincide with the point.
  std::vector<std::uint32_t> lightsAt(const LitPoint& point) const
  {
    return lamps_->lightsAt(frame_.contacts, point.on);
  }
  /// What the lights emit that coincide with the point.
  void addTouching(const LitPoint& point, const std::vector<std::uint32_t>& touching,
    std::size_t replicates, std::vector<Arrival>& arrivals) const;
  /// `touching`: lights that are not asked.
  void addSamples(const LitPoint& point, SeenLight::By by, const Part& part, std::uint64_t number,
    std::uint32_t share, const std::vector<std::uint32_t>& touching, std::size_t replicates,
    std::vector<Arrival>& arrivals) const;
  std::vector<Arrival> arrivalsAt(
    const LitPoint& point, std::uint64_t number, std::size_t replicates) const;
  /// What no other surface stops. `mayPass`: clear sheets.
  Bands arriving(const LitPoint& point, const std::vector<Arrival>& arrivals, bool mayPass,
    std::vector<ShadowRay>* rays = nullptr) const;
  Bands broughtBy(const Arrival& arrival) const
  {
    return arrival.perWatt * lights()[arrival.light].flux;
  }
  /// What arrivals meet.
  std::vector<ClearSheets::Way> cast(
    const LitPoint& point, const std::vector<Arrival>& arrivals, bool mayPass) const;
  /// The part of the light.
  double arrivingBy(const ClearSheets::Way& way, const LitPoint& point) const;
  ShadowRay shadowRayOf(
    const Arrival& arrival, const LitPoint& point, const ClearSheets::Way& way) const;

  const Frame& frame_;
  std::shared_ptr<const LampPieces> lamps_;
  std::uint64_t seed_;
  std::uint32_t samples_;
  std::size_t mostWeights_;
};

}
