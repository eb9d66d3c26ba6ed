#include "RigidObject.h"

#include <utility>

namespace irradiance
{

namespace
{

EnclosingEllipsoid enclose(const TriangleMesh& mesh)
{
  std::vector<Vector3> points;
  points.reserve(3 * mesh.size());
  for (const Triangle& triangle : mesh.triangles())
  {
    points.insert(points.end(), { triangle.a, triangle.b, triangle.c });
  }
  return points.empty() ? EnclosingEllipsoid{ Vector3::Zero(), Matrix3::Identity() }
                        : encloseByEllipsoid(points);
}

}

RigidObject::RigidObject(TriangleMesh mesh, const Checkpoint& checkpoint)
  : mesh_(std::move(mesh))
  , tree_(treeOf(mesh_.triangles(), checkpoint))
  , ellipsoid_(enclose(mesh_))
{
}

}
