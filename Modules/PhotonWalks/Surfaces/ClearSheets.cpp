// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/ClearSheets.h"

#include "Sampling/SobolPoint.h"

#include <cmath>

namespace irradiance
{

Hit ClearSheets::stop(const Ray& ray, const Hit& closest, const TriangleId& target,
  std::uint64_t number, double end) const
{
  Hit hit = closest;
  for (Ray rest = ray;
       hit && hit.distance < end && hit.id != target && passes(hit.id, ray.direction, number);)
  {
    const double gone = hit.distance;
    const bool goesToFront = scene.worldTriangle(hit.id).areaVector().dot(ray.direction) > 0;
    rest = { scene.surfaceOf(hit, goesToFront).clearPosition(), ray.direction, hit.id };
    hit = scene.cast(rest);
    hit = contacts ? contacts->resolveContact(scene, rest, hit) : hit;
    hit.distance += gone;
  }
  return hit;
}

bool ClearSheets::passes(
  const TriangleId& sheet, const Vector3& direction, std::uint64_t number) const
{
  const Material& material = *objects[sheet.object].material;
  const std::size_t cell = material.hasSheets() ? material.cellOfTriangle[sheet.triangle] : 0;
  if (!material.hasSheets() || !material.isClear(cell))
  {
    return false;
  }
  const double cosine = material.isPane(cell)
    ? std::abs(scene.worldTriangle(sheet).areaVector().normalized().dot(direction.normalized()))
    : 1;
  const std::uint64_t hash =
    splitMix(number ^ splitMix(std::uint64_t{ sheet.object } << 32 | sheet.triangle));
  return static_cast<double>(hash >> 11) * 0x1p-53 <
    material.partOf(Leaving::Straight, cell, cosine)[0];
}

}
