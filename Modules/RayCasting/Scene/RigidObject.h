// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Ellipsoids/EnclosingEllipsoid.h"
#include "Meshes/TriangleMesh.h"
#include "Trees/DetailTrees.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace irradiance
{

/// Triangles that move together: the mesh, its tree and its ellipsoid in model space, built once. A
/// body that does not move needs no ellipsoid, but may be large and have fine details.
class RigidObject
{
public:
  explicit RigidObject(TriangleMesh mesh, const CancelPoint& cancelPoint = {}, bool mayMove = true)
    : mesh_(std::move(mesh))
    , tree_(treeOf(mesh_.triangles(), cancelPoint))
    , detailTrees_(mayMove ? std::vector<TriangleTree>() : detailTreesOf(mesh_, cancelPoint))
    , ellipsoid_(mayMove ? enclose(mesh_, cancelPoint) : EnclosingEllipsoid())
  {
  }

  const TriangleMesh& mesh() const { return mesh_; }
  const TriangleTree& tree() const { return tree_; }
  /// Calls visit(tree) for trees that hold each triangle once, and are quicker than the one of all
  /// where there are fine details.
  template <class Visit>
  void forEachTree(const Visit& visit) const
  {
    detailTrees_.empty()
      ? visit(tree_)
      : static_cast<void>(std::for_each(detailTrees_.begin(), detailTrees_.end(), visit));
  }
  /// Meaningful only if the body may move.
  const EnclosingEllipsoid& ellipsoid() const { return ellipsoid_; }

private:
  static EnclosingEllipsoid enclose(const TriangleMesh& mesh, const CancelPoint& cancelPoint)
  {
    std::vector<Vector3> points;
    points.reserve(3 * mesh.size());
    ThrottledCancelPoint pace(cancelPoint);
    for (const Triangle& triangle : mesh.triangles())
    {
      points.insert(points.end(), { triangle.a, triangle.b, triangle.c });
      pace.step();
    }
    return points.empty() ? EnclosingEllipsoid() : encloseByEllipsoid(points, cancelPoint);
  }

  TriangleMesh mesh_;
  TriangleTree tree_;
  std::vector<TriangleTree> detailTrees_; ///< see there; none if the body may move
  EnclosingEllipsoid ellipsoid_;
};

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
