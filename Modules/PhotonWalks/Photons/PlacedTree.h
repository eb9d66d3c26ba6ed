// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/UnitFrame.h"
#include "Photons/Sensor.h"
#include "Surfaces/SceneObjects.h"
#include "Trees/LeafQuery.h"
#include "Trees/SurfaceTree.h"

#include <algorithm>

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
  float least; ///< no vector of length 1 in the unit frame is shorter, flattened or not
};

/// How many triangles of a node have a property.
enum class Share
{
  None,
  Some, ///< or not known
  All
};

/// Of the triangles that face a direction in the unit frame, on whichever side, see Facing.
Share facingShare(const SurfaceNode& node, const Vector3& direction);

/**
 * The tree of an object in its pose: distances in its unit frame and in the world. The latter are
 * in search units, a power of two of the world's, so that floats suffice at every scale.
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

  /// Of the object in the world.
  double size() const { return size_; }
  bool isMirrored() const { return linear_.determinant() < 0; }
  /// Whether the pose keeps angles, as it turns, mirrors and scales alone. The following hold if it
  /// does; their unit frame is the frame of the object's SurfaceTree.
  bool keepsAngles() const { return worldUnitsPerUnit_ > 0; }
  double worldUnitsPerUnit() const { return worldUnitsPerUnit_; }
  Vector3 unitPoint(const Vector3& world) const
  {
    return surfaceFrame_(inverse_ * (world - worldFromObject_.translation));
  }
  Vector3 unitDirection(const Vector3& world) const { return turn_.transpose() * world; }
  /// False if no triangle of the node faces a direction in the world.
  bool mayFace(const SurfaceNode& node, const Vector3& world) const
  {
    return !keepsAngles() || facingShare(node, unitDirection(world)) != Share::None;
  }
  /// No point of the node is closer to a place, given in the unit frame, than this; world.
  double distanceAtLeast(const SurfaceNode& node, const Vector3& unit) const
  {
    return leastWorldUnits_ *
      std::max((node.center - unit).norm() * (1 - 0x1p-40) - node.radius - blurAt(unit), 0.0);
  }

private:
  /// Positions in the unit frame of the surface are off by less, as are world positions in that
  /// unit.
  double blurAt(const Vector3& unit) const
  {
    return 0x1p-44 * condition_ *
      (2 + unit.norm() + surfaceFrame_.scale * surfaceFrame_.center.norm());
  }

  UnitFrame frame_, surfaceFrame_;
  AffineMap worldFromObject_;
  Matrix3 inverse_; ///< of the linear part
  Matrix3 linear_;  ///< the linear part times a power of two: its largest entry is about 1
  Box bounds_;      ///< world, rounded outwards
  Matrix3 stretch_; ///< from a vector in the unit frame to search units
  float least_;
  double searchUnitsPerWorldUnit_;
  double longest_;   ///< no vector of length 1 in the unit frame is longer in the flattened world
  double condition_; ///< of the linear part
  double size_;
  double leastWorldUnits_; ///< no vector of length 1 in the unit frame of the surface is shorter
  double worldUnitsPerUnit_ = 0; ///< 0 if it depends on the direction
  Matrix3 turn_;                 ///< from the unit frame to the world; only if angles stay
};

}
