#include "TriangleMesh.h"

#include <utility>

namespace irradiance
{

TriangleMesh::TriangleMesh(std::vector<Triangle> triangles)
  : triangles_(std::move(triangles))
{
  for (const Triangle& triangle : triangles_)
  {
    bounds_.add(triangle.bounds());
  }
}

}
