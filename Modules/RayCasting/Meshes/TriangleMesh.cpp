// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/TriangleMesh.h"

#include "Meshes/SurfacePoint.h"

#include <algorithm>
#include <utility>

namespace irradiance
{

TriangleMesh::TriangleMesh(std::vector<Triangle> triangles, const CancelPoint& cancelPoint)
  : triangles_(std::move(triangles))
{
  ThrottledCancelPoint pace(cancelPoint);
  for (const Triangle& triangle : triangles_)
  {
    bounds_.add(triangle.bounds());
    const double a = (triangle.c - triangle.b).norm(), b = (triangle.a - triangle.c).norm(),
                 c = (triangle.b - triangle.a).norm(), area = triangle.areaVector().norm();
    const double longest = std::max({ a, b, c });
    longestEdge_ = std::max(longestEdge_, longest);
    const double slenderness = area > 0 ? longest * (a + b + c) / area : 0.0;
    slenderness_ = std::max(slenderness_, slenderness);
    clearance_ =
      std::max(clearance_, farthestClearance(triangle.bounds().magnitude(), longest, slenderness));
    pace.step();
  }
}

}
