// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Photons/Foot.h"
#include "Photons/LeafPhotons.h"
#include "Photons/SeenSurface.h"

#include <optional>
#include <vector>

namespace irradiance
{

/// The photons nearest to a sensor.
struct NearPhotons
{
  std::vector<SegmentRef> photons; ///< the farthest comes last, the others in any order
  /// Distance of the farthest, in the flattened world of the sensor; the largest that was allowed
  /// if there are not so many.
  double radius;
  bool areAll; ///< there are fewer than asked for
};

/**
 * Exact search of the nearest photons that arrived on surface that counts for a sensor (section 4.1
 * of the paper; SeenSurface says what counts). It begins at the leaf nearest to the sensor and goes
 * outward through the trees of all objects. Floats find the candidates, as in ray casting; where
 * two are as far as rounding can tell, the stored walks decide. So it finds what a search of all
 * photons would find, ordered by distance squared in double, walk and bounce, whatever the trees
 * look like.
 *
 * Any number of threads may search at a time.
 */
class NearestPhotons
{
public:
  /// For one frame; all of them must outlive it, the histories themselves too.
  NearestPhotons(const LeafPhotons& leaves, const Surfaces& surfaces, const SceneObjects& objects,
    const WalkHistories& histories);

  /// Where a sensor stands; nothing if that is farther away than `maximumDistance`, or if the
  /// sensor is so far from the scene that distances in double tell little of what is nearer.
  std::optional<Foot> footOf(const Sensor& sensor, double maximumDistance = kInfinity) const;
  /// The `count` >= 1 nearest within a distance in the flattened world, which may be infinite.
  NearPhotons find(const Foot& foot, std::size_t count, double maximumRadius = kInfinity) const;
  /// The world area of all surface that counts within a radius in the flattened world, see
  /// SeenSurface.
  double areaWithin(const Foot& foot, double radius) const;

  /// By which distances are compared: in double, from the point given by the stored weights.
  double squaredDistance(const Sensor& sensor, const SegmentRef& photon) const
  {
    const Hit hit = historyOf(histories_, photon.walk).hit(photon);
    const SceneObject& object = objects_[hit.id.object];
    return sensor.squaredDistance(
      object.worldFromObject(modelPoint(object.body->mesh(), hit.id.triangle, hit.weights)));
  }

  const SceneObjects& objects() const { return objects_; }
  Power power(const SegmentRef& photon) const
  {
    return historyOf(histories_, photon.walk).power(photon);
  }
  std::size_t numberOfPhotons() const { return leaves_.size(); }
  /// Of the scene.
  const Box& bounds() const { return bounds_; }

private:
  class Search;

  SeenSurface seen(std::uint32_t object, const Foot& foot) const
  {
    return { objects_[object], surfaces_.of(object), trees_[object], foot };
  }

  const LeafPhotons& leaves_;
  const Surfaces& surfaces_;
  const SceneObjects& objects_;
  WalkHistories histories_;
  Box bounds_;
  double searchUnitsPerWorldUnit_;
  std::vector<PlacedTree> trees_;
  std::vector<std::uint32_t> lit_; ///< objects with photons
};

/**
 * Power over area is the irradiance at a sensor: the power of the photons nearest to its foot, over
 * the surface that counts within the sphere through the farthest of them, in the flattened world of
 * the sensor. As only surface that is there counts, nothing is lost at edges and in corners; and as
 * the same surface counts for photons and for area, what does not count leaves no bias.
 *
 * The farthest photon sets the radius and is not counted itself: of k photons scattered evenly over
 * surface, k - 1 over the area that reaches to the k-th has their density as its mean, k over that
 * area k / (k - 1) times as much (Loftsgaarden and Quesenberry 1965).
 */
struct NearestEstimate
{
  /// Where there are fewer photons than asked for, all count, and the sphere has the largest radius
  /// that is allowed.
  Power power;
  /// World; if it is 0, there is no surface and nothing is known. Infinite if the power is 0, which
  /// is then the irradiance, however large the area is.
  double area;
  double radius;       ///< in the flattened world
  std::uint32_t found; ///< photons, at most those asked for
};

/// `count`: >= 2.
NearestEstimate nearestEstimate(const NearestPhotons& photons, const Foot& foot,
  std::uint32_t count, double maximumRadius = kInfinity);

/// The largest radius if the user sets none: four times the one that `count` photons fill
/// on the average of the scene, at most a quarter of the scene's largest extent. World.
double usualRadius(const NearestPhotons& photons, std::uint32_t count);
/// How far from a surface a sensor may lie and still counts as on it, if the user sets no distance.
/// World.
double usualDistance(const NearestPhotons& photons);

}
