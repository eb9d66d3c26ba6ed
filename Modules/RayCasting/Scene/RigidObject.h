// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_RigidObject_h
#define irradiance_RigidObject_h

#include "Ellipsoids/EnclosingEllipsoid.h"
#include "Meshes/TriangleMesh.h"
#include "Trees/TriangleTree.h"

namespace irradiance
{

/// Triangles that move together: the mesh, its tree and its ellipsoid in model space, built once. A
/// body that does not move needs no ellipsoid.
class RigidObject
{
public:
  explicit RigidObject(TriangleMesh mesh, const CancelPoint& cancelPoint = {}, bool mayMove = true);

  const TriangleMesh& mesh() const { return mesh_; }
  const TriangleTree& tree() const { return tree_; }
  /// Meaningful only if the body may move.
  const EnclosingEllipsoid& ellipsoid() const { return ellipsoid_; }

private:
  TriangleMesh mesh_;
  TriangleTree tree_;
  EnclosingEllipsoid ellipsoid_;
};

}

#endif
