// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/RigidObject.h"

#include <utility>

namespace irradiance
{

namespace
{

EnclosingEllipsoid enclose(const TriangleMesh& mesh, const CancelPoint& cancelPoint)
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

}

RigidObject::RigidObject(TriangleMesh mesh, const CancelPoint& cancelPoint, bool mayMove)
  : mesh_(std::move(mesh))
  , tree_(treeOf(mesh_.triangles(), cancelPoint))
  , detailTrees_(mayMove ? std::vector<TriangleTree>() : detailTreesOf(mesh_, cancelPoint))
  , ellipsoid_(mayMove ? enclose(mesh_, cancelPoint) : EnclosingEllipsoid())
{
}

}
