// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/ClearSheets.h"

#include "Sampling/SobolPoint.h"

#include <cmath>

namespace irradiance
{

namespace
{

/// In [0, 1). Of 32 numbers in a row, from a multiple of 32 on, each has a 32nd of its own; what
/// different keys and other such rows have is independent.
double evenSample(std::uint64_t number, std::uint64_t key)
{
  constexpr int kDigits = 5;
  constexpr std::uint64_t kRow = (1u << kDigits) - 1;
  std::uint64_t reversed = 0;
  for (int digit = 0; digit < kDigits; ++digit)
  {
    reversed |= (number >> digit & 1) << (63 - digit);
  }
  const std::uint64_t shift = splitMix((number & ~kRow) ^ key) & kRow << (64 - kDigits);
  const std::uint64_t within = splitMix(splitMix(number) ^ key) >> kDigits;
  return static_cast<double>(((reversed ^ shift) | within) >> 11) * 0x1p-53;
}

}

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
  return evenSample(number, splitMix(std::uint64_t{ sheet.object } << 32 | sheet.triangle)) <
    material.partOf(Leaving::Straight, cell, cosine)[0];
}

}
