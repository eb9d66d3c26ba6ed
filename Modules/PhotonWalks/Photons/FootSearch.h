// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_FootSearch_h
#define irradiance_FootSearch_h

#include "Geometry/Ray.h"
#include "Photons/Foot.h"
#include "Photons/PlacedTree.h"
#include "Photons/Surfaces.h"

#include <optional>
#include <vector>

namespace irradiance
{

/// Finds where a sensor stands.
class FootSearch
{
public:
  /// All of them must outlive it. `placed`: the trees of the objects in their poses.
  FootSearch(const SceneObjects& objects, const Surfaces& surfaces,
    const std::vector<PlacedTree>& placed, const Sensor& sensor);

  /**
   * No farther than `maximumDistance`. Sides that are inside of a body are taken only if they are
   * less than half as far as others: a sensor near a thin object, but not quite on it, stands
   * outside. Of several places at one distance the first by object and triangle.
   */
  std::optional<Foot> find(double maximumDistance);

private:
  struct Found
  {
    double squaredDistance = kInfinity;
    TriangleId id;
    int side = 0;

    bool isCloser(const Found& other) const;
  };

  /// From the sensor to the closest point of a triangle, world.
  Vector3 closestOn(const TriangleId& id) const;
  /// On a side of a triangle.
  Foot on(const TriangleId& id, int side) const;
  double limit() const;
  void search(std::uint32_t object, std::size_t node, const Facing& facing, const Vector3& unit);
  void test(std::uint32_t object, std::uint32_t triangle, const Facing& facing);

  const SceneObjects& objects_;
  const Surfaces& surfaces_;
  const std::vector<PlacedTree>& placed_;
  const Sensor& sensor_;
  double maximumDistance_ = kInfinity;
  Found inside_, outside_;
};

}

#endif
