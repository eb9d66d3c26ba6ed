// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/ClearSheets.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace irradiance
{

std::vector<ClearSheets::Way> ClearSheets::follow(const Ray* rays, const Hit* closest,
  std::size_t count, const std::function<TriangleId(std::size_t)>& targetOf, double end) const
{
  std::vector<Way> ways(count);
  std::transform(closest, closest + count, ways.begin(), [](const Hit& hit) { return Way{ hit }; });
  std::vector<std::size_t> open(count);
  std::iota(open.begin(), open.end(), std::size_t{});
  while (!open.empty())
  {
    std::vector<Ray> rests;
    std::vector<std::size_t> goOn;
    for (const std::size_t i : open)
    {
      Way& way = ways[i];
      const Vector3& along = rays[i].direction;
      const bool isOnTheWay = way.hit && way.hit.distance < end && way.hit.id != targetOf(i);
      const double part = isOnTheWay ? passing(way.hit.id, along) : 0;
      if (part > 0)
      {
        way.passed = std::max(0x1p-24, 0x1p-24 * std::floor(0x1p24 * way.passed * part + 0.5));
        way.meetsMovers = way.meetsMovers || way.hit.id.isDynamic();
        const bool goesToFront = scene.worldTriangle(way.hit.id).areaVector().dot(along) > 0;
        rests.push_back(
          { scene.surfaceOf(way.hit, goesToFront).clearPosition(), along, way.hit.id });
        goOn.push_back(i);
      }
    }
    std::vector<Hit> next(rests.size());
    scene.cast(rests.data(), rests.size(), next.data());
    for (std::size_t i = 0; i < next.size(); ++i)
    {
      Hit& hit = ways[goOn[i]].hit;
      const double gone = hit.distance;
      hit = contacts ? contacts->resolveContact(scene, rests[i], next[i]) : next[i];
      hit.distance += gone;
    }
    open = std::move(goOn);
  }
  return ways;
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
