// SPDX-License-Identifier: BSD-3-Clause
#include "DirectLight/DarkSides.h"

#include "Surfaces/CoincidentTriangles.h"

#include <algorithm>

namespace irradiance
{

namespace
{

/// By object, whether any light lies within its bounds, or touches them. The static object is not
/// looked at.
std::vector<bool> haveLights(const SceneObjects& objects, const std::vector<Box>& lights)
{
  std::vector<bool> have(objects.size(), true);
  for (std::uint32_t i = 1; i < objects.size(); ++i)
  {
    Box bounds = objects.dynamicObjects[i - 1].worldBounds();
    bounds.inflate(8 * kTouching * bounds.magnitude());
    have[i] = std::any_of(lights.begin(), lights.end(),
      [&](const Box& light) { return !bounds.intersection(light).isEmpty(); });
  }
  return have;
}

/// Whether a box is nowhere in front of a plane.
bool isBehind(const Box& box, const Vector3& point, const Vector3& normal, double slack = 0)
{
  const Vector3 half = 0.5 * box.extent();
  return normal.dot(box.center() - point) + normal.cwiseAbs().dot(half) <= slack;
}

bool isFlat(const CellShape& shape)
{
  return shape.normal.norm() >= 1 - 1e-12;
}

}

void markInnerSides(CellShapes& cells, const Frame& frame, const std::vector<Box>& lights)
{
  const std::vector<bool> haveLight = haveLights(frame.objects, lights);
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
  {
    const auto isSolid = [&](SolidSide side) {
      return std::all_of(cells.begin(cell), cells.end(cell), [&](std::uint32_t number) {
        const TriangleId id = frame.triangles.idOf(number);
        return !haveLight[id.object] && frame.sides[id.object].of[id.triangle] == side &&
          frame.sides[id.object].shell(id.triangle).isSimple;
      });
    };
    if (cells.begin(cell) != cells.end(cell))
    {
      cells.setDark(cell, isSolid(SolidSide::InFront), isSolid(SolidSide::Behind));
    }
  }
}

void markOuterSides(
  CellShapes& cells, const Box& bounds, const std::vector<const DistantLight*>& distant)
{
  const auto mayComeTo = [&](const Vector3& normal) {
    return std::any_of(distant.begin(), distant.end(),
      [&](const DistantLight* light) { return light->mayComeTo(normal); });
  };
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
  {
    const CellShape& shape = cells[cell];
    if (isFlat(shape))
    {
      // For rounding; rays start clear of the surface by far more, see SurfacePoint.
      const double slack = 0x1p-40 * shape.center.cwiseAbs().maxCoeff();
      const auto isOuter = [&](const Vector3& normal) {
        return isBehind(bounds, shape.center, normal, slack) && !mayComeTo(normal);
      };
      cells.setDark(cell, shape.isFrontDark || isOuter(shape.normal),
        shape.isBackDark || isOuter(-shape.normal));
    }
  }
}

void markDarkSides(CellShapes& cells, const Frame& frame, const LightTable& lights)
{
  std::vector<Box> each;
  Box bounds;
  for (const Light& light : lights.lights())
  {
    each.push_back(light.stand());
    bounds.add(light.bounds());
  }
  markInnerSides(cells, frame, each);
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
  {
    const CellShape& shape = cells[cell];
    const bool isFront = shape.isFrontDark, isBack = shape.isBackDark;
    const Vector3 outwards = isFront ? Vector3(-shape.normal) : shape.normal;
    const bool isAway =
      (isFront || isBack) && isFlat(shape) && isBehind(bounds, shape.center, outwards);
    cells.setDark(cell, isFront || (isBack && isAway), isBack || (isFront && isAway));
  }
}

}
