// SPDX-License-Identifier: BSD-3-Clause
#include "History/PointFrame.h"

#include <algorithm>
#include <array>
#include <vector>

namespace irradiance
{

namespace
{

/// The coordinates, axis by axis, of one corner of every n-th triangle.
std::array<std::vector<double>, 3> someCorners(const SceneObjects& objects)
{
  constexpr std::size_t kEnough = 10000;
  std::size_t triangles = 0;
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    triangles += objects[i].mesh().size();
  }
  const std::size_t step = triangles / kEnough + 1;
  std::array<std::vector<double>, 3> corners;
  std::size_t toNext = 0;
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    const TriangleMesh& mesh = objects[i].mesh();
    for (; toNext < mesh.size(); toNext += step)
    {
      const Vector3 corner = objects[i].worldFromObject(mesh[toNext].a);
      for (std::size_t axis = 0; axis < corners.size(); ++axis)
      {
        corners[axis].push_back(corner[static_cast<int>(axis)]);
      }
    }
    toNext -= mesh.size();
  }
  return corners;
}

}

UnitFrame pointFrame(const SceneObjects& objects, const Box& bounds)
{
  UnitFrame frame(bounds);
  std::array<std::vector<double>, 3> corners = someCorners(objects);
  for (std::size_t axis = 0; axis < corners.size() && !corners[axis].empty(); ++axis)
  {
    const auto middle =
      corners[axis].begin() + static_cast<std::ptrdiff_t>(corners[axis].size() / 2);
    std::nth_element(corners[axis].begin(), middle, corners[axis].end());
    frame.center[static_cast<int>(axis)] = *middle;
  }
  return frame;
}

}
