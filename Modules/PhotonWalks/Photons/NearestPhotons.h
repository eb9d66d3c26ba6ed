// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_NearestPhotons_h
#define irradiance_NearestPhotons_h

#include "Photons/LeafPhotons.h"
#include "Photons/PlacedTree.h"

#include <vector>

namespace irradiance
{

/// The photons nearest to a sensor.
struct NearPhotons
{
  std::vector<PhotonReference> photons; ///< the farthest comes last, the others in any order
  /// Distance of the farthest, in the flattened world of the sensor; the largest that was allowed if
  /// there are not so many.
  double radius;
  bool areAll; ///< there are fewer than asked for
};

/**
 * Exact search of the nearest photons that arrived on sides facing as the sensor does (section 4.1 of
 * the paper). It begins at the leaf nearest to the sensor and goes outward through the trees of all
 * objects. Floats find the candidates, as in ray casting; where two are as far as rounding can tell,
 * the stored walks decide. So it finds what a search of all photons would find, ordered by distance
 * squared in double, walk and bounce, whatever the trees look like.
 *
 * Any number of threads may search at a time.
 */
class NearestPhotons
{
public:
  /// For one frame; all of them must outlive it.
  NearestPhotons(
    const LeafPhotons& leaves, const SceneObjects& objects, const WalkHistory& history);

  /// The `count` >= 1 nearest within a distance in the flattened world, which may be infinite.
  NearPhotons find(const Sensor& sensor, std::size_t count, double maximumRadius = kInfinity) const;

  /// By which distances are compared: in double, from the point given by the stored weights.
  double squaredDistance(const Sensor& sensor, const PhotonReference& photon) const
  {
    const Hit hit = history_.hit(photon);
    const SceneObject& object = objects_[hit.id.object];
    const Vector3 model = modelPoint(object.body->mesh(), hit.id.triangle, hit.weights);
    return sensor.squaredDistance(object.worldFromObject(model));
  }

  /// Whether a sensor is so far from the scene that distances in double tell little of what is nearer.
  bool isTooFar(const Sensor& sensor) const
  {
    const Vector3 away =
      (bounds_.lower - sensor.position).cwiseMax(sensor.position - bounds_.upper);
    return away.maxCoeff() * searchUnitsPerWorldUnit_ > kFarthest;
  }

  const SceneObjects& objects() const { return objects_; }
  const WalkHistory& history() const { return history_; }
  const LeafPhotons& leaves() const { return leaves_; }
  const PlacedTree& tree(std::uint32_t object) const { return trees_[object]; }

private:
  class Search;

  /// In sizes of the scene. From there a disc of a fiftieth of the scene is as far as its middle.
  static constexpr double kFarthest = 0x1p20;

  const LeafPhotons& leaves_;
  const SceneObjects& objects_;
  const WalkHistory& history_;
  Box bounds_; ///< of the scene
  double searchUnitsPerWorldUnit_;
  std::vector<PlacedTree> trees_;
  std::vector<std::uint32_t> lit_; ///< objects with photons
};

}

#endif
