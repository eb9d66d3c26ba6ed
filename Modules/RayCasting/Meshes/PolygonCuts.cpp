// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/PolygonCuts.h"

#include <cstddef>

namespace irradiance
{

std::vector<Triangle> cutFan(const std::vector<Vector3>& corners)
{
  std::vector<Triangle> triangles;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
  {
    triangles.push_back({ corners[0], corners[i], corners[i + 1] });
  }
  return triangles;
}

std::vector<Triangle> cutConvex(const std::vector<Vector3>& corners)
{
  std::vector<Triangle> triangles;
  for (std::size_t step = 1; step < corners.size(); step *= 2)
  {
    for (std::size_t i = 0; i + step < corners.size(); i += 2 * step)
    {
      const std::size_t end = i + 2 * step < corners.size() ? i + 2 * step : 0;
      if (i != end)
      {
        triangles.push_back({ corners[i], corners[i + step], corners[end] });
      }
    }
  }
  return triangles;
}

std::optional<std::vector<Triangle>> cutQuad(const std::vector<Vector3>& corners)
{
  const auto isInside = [](const Triangle& one, const Triangle& other) {
    return one.areaVector().dot(other.areaVector()) >= 0;
  };
  const Triangle a{ corners[0], corners[1], corners[2] };
  const Triangle b{ corners[0], corners[2], corners[3] };
  if (isInside(a, b))
  {
    return std::vector<Triangle>{ a, b };
  }
  const Triangle c{ corners[0], corners[1], corners[3] };
  const Triangle d{ corners[1], corners[2], corners[3] };
  if (isInside(c, d))
  {
    return std::vector<Triangle>{ c, d };
  }
  return std::nullopt;
}

}
