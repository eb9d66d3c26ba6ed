// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PlacedTree_h
#define irradiance_PlacedTree_h

#include "Geometry/UnitFrame.h"
#include "Light/SceneObjects.h"
#include "Photons/Sensor.h"
#include "Trees/LeafQuery.h"

namespace irradiance
{

/// A sensor as the tree of an object sees it. Distances are in search units, see PlacedTree.
struct LocalSensor
{
  UnitPoint position;      ///< in the unit frame of the tree
  Eigen::Matrix3f stretch; ///< from a vector in the unit frame to the flattened world
  /// Distances to photons, computed in floats, are off by less than this, and so are those to the
  /// boxes of their leaves.
  float blur;
};

/**
 * The tree of an object in its pose: distances in its unit frame and in the world. The latter are in
 * search units, a power of two of the world's, so that floats suffice at every scale.
 */
class PlacedTree
{
public:
  PlacedTree(const SceneObject& object, double searchUnitsPerWorldUnit);

  LocalSensor see(const Sensor& sensor) const;
  /// No point of the object is closer to a world point than this, world units.
  double distanceAtLeast(const Vector3& point) const
  {
    const Vector3 outside = (bounds_.lower - point).cwiseMax(point - bounds_.upper).cwiseMax(0.0);
    return outside.norm();
  }
  Facing facing(const Sensor& sensor) const { return { linear_, frame_.scale, sensor.normal }; }

  /// No vector of length 1 in the unit frame is shorter than this in search units, flattened or not.
  float least() const { return least_; }
  /// Bounds, in the object's space, of what lies within a distance of a sensor in its flattened world.
  Box modelBounds(const Sensor& sensor, double radius) const;

private:
  UnitFrame frame_;
  AffineMap worldFromObject_;
  Matrix3 inverse_; ///< of the linear part
  Matrix3 linear_;  ///< the linear part times a power of two: its largest entry is about 1
  Box bounds_;      ///< world, rounded outwards
  Matrix3 stretch_; ///< from a vector in the unit frame to search units
  float least_;
  double searchUnitsPerWorldUnit_;
  double longest_;   ///< no vector of length 1 in the unit frame is longer in the flattened world
  double condition_; ///< of the linear part
};

}

#endif
