// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PlacedBody_h
#define irradiance_PlacedBody_h

#include "Geometry/MovedBox.h"
#include "Scene/RigidObject.h"

#include <memory>

namespace irradiance
{

/// A body and its pose in one frame.
struct PlacedBody
{
  std::shared_ptr<const RigidObject> body;
  AffineMap worldFromObject;
  /// If true, its triangles stand one by one in a tree that every Scene::commit() rebuilds.
  /// Otherwise the body is searched in its own tree, behind its ellipsoid.
  bool isFlattened = false;
  /// Whether it is part of this frame. If not, it is treated as if it had no triangles.
  bool isPresent = true;

  /// The triangles that are there in this frame.
  const TriangleMesh& mesh() const
  {
    static const TriangleMesh none;
    return isPresent ? body->mesh() : none;
  }
  bool isEmpty() const { return mesh().isEmpty(); }
  /// Whether the pose turns the fronts of its triangles over.
  bool isMirrored() const { return worldFromObject.linear.determinant() < 0; }
  Box worldBounds() const { return isEmpty() ? Box() : movedBox(worldFromObject, mesh().bounds()); }
};

}

#endif
