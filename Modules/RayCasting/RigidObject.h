#ifndef irradiance_RigidObject_h
#define irradiance_RigidObject_h

#include "EnclosingEllipsoid.h"
#include "KdTreeBuilder.h"

namespace irradiance
{

/// Triangles that move together: the mesh, its tree and its ellipsoid in model space, made once.
class RigidObject
{
public:
  explicit RigidObject(TriangleMesh mesh, const Checkpoint& checkpoint = {});

  const TriangleMesh& mesh() const { return mesh_; }
  const KdTree& tree() const { return tree_; }
  const EnclosingEllipsoid& ellipsoid() const { return ellipsoid_; }

private:
  TriangleMesh mesh_;
  KdTree tree_;
  EnclosingEllipsoid ellipsoid_;
};

/// A tree over the triangles of a mesh in the mesh's own space.
KdTree buildTriangleTree(const TriangleMesh& mesh, const Checkpoint& checkpoint = {});

}

#endif
