// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/ClearSheets.h"

#include <algorithm>
#include <cmath>

namespace irradiance
{

ClearSheets::Way ClearSheets::follow(
  const Ray& ray, const Hit& closest, const TriangleId& target, double end) const
{
  Way way{ closest };
  Ray rest = ray;
  while (way.hit && way.hit.distance < end && way.hit.id != target)
  {
    const TriangleId sheet = way.hit.id;
    const double part = passing(sheet, ray.direction);
    if (!(part > 0))
    {
      break;
    }
    way.passed = std::max(0x1p-24, 0x1p-24 * std::floor(0x1p24 * way.passed * part + 0.5));
    way.meetsMovers = way.meetsMovers || sheet.isDynamic();
    const double gone = way.hit.distance;
    const bool goesToFront = scene.worldTriangle(sheet).areaVector().dot(ray.direction) > 0;
    rest = { scene.surfaceOf(way.hit, goesToFront).clearPosition(), ray.direction, sheet };
    way.hit = scene.cast(rest);
    way.hit = contacts ? contacts->resolveContact(scene, rest, way.hit) : way.hit;
    way.hit.distance += gone;
  }
  return way;
}

double ClearSheets::passing(const TriangleId& sheet, const Vector3& direction) const
{
  const Material& material = *objects[sheet.object].material;
  const std::size_t cell = material.hasSheets() ? material.cellOfTriangle[sheet.triangle] : 0;
  if (!material.hasSheets() || !material.isClear(cell))
  {
    return 0;
  }
  const double cosine = material.isPane(cell)
    ? std::abs(scene.worldTriangle(sheet).areaVector().normalized().dot(direction.normalized()))
    : 1;
  return material.partOf(Leaving::Straight, cell, cosine)[0];
}

}
