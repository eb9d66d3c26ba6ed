// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_NearestPhotons_h
#define irradiance_NearestPhotons_h

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
  /// The world area of what counts of an object's surface, see SeenSurface.
  double areaWithin(std::uint32_t object, const Foot& foot, double radius) const
  {
    const bool isNear = trees_[object].distanceAtLeast(foot.sensor.position) <= radius;
    return isNear ? seen(object, foot).areaWithin(radius) : 0.0;
  }

  /// By which distances are compared: in double, from the point given by the stored weights.
  double squaredDistance(const Sensor& sensor, const SegmentRef& photon) const
  {
    const Hit hit = histories_.hit(photon);
    const SceneObject& object = objects_[hit.id.object];
    return sensor.squaredDistance(
      object.worldFromObject(modelPoint(object.body->mesh(), hit.id.triangle, hit.weights)));
  }

  const SceneObjects& objects() const { return objects_; }
  const WalkHistories& histories() const { return histories_; }
  std::size_t numberOfPhotons() const { return leaves_.size(); }
  /// Of the scene.
  const Box& bounds() const { return bounds_; }

private:
  class Search;

  SeenSurface seen(std::uint32_t object, const Foot& foot) const
  {
    return { objects_[object], surfaces_.of(object), trees_[object], foot };
  }
  bool isTooFar(const Sensor& sensor) const
  {
    const Vector3 away =
      (bounds_.lower - sensor.position).cwiseMax(sensor.position - bounds_.upper);
    return away.maxCoeff() * searchUnitsPerWorldUnit_ > kFarthest;
  }

  /// In sizes of the scene. From there a disc of a fiftieth of the scene is as far as its middle.
  static constexpr double kFarthest = 0x1p20;

  const LeafPhotons& leaves_;
  const Surfaces& surfaces_;
  const SceneObjects& objects_;
  WalkHistories histories_;
  Box bounds_;
  double searchUnitsPerWorldUnit_;
  std::vector<PlacedTree> trees_;
  std::vector<std::uint32_t> lit_; ///< objects with photons
};

}

#endif
