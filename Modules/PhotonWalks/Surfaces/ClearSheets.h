// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Scene/Scene.h"
#include "Surfaces/Contacts.h"
#include "Surfaces/SceneObjects.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

namespace irradiance
{

/// What is left of the light of a ray that looks for lamps, as clear sheets let it go straight on.
struct ClearSheets
{
  const SceneObjects& objects;
  const Scene& scene;
  const Contacts* contacts = nullptr; ///< null: nothing coincides

  /// Where a ray ends, and what clear sheets before leave.
  struct Way
  {
    Hit hit;
    double passed = 1;        ///< > 0, a multiple of 2^-24
    bool meetsMovers = false; ///< some of these sheets are dynamic
  };
  /// What stops each ray before its length is `end`, or is hit then. `closest`: their closest hits;
  /// `targetOf`: by place, where it is to arrive.
  std::vector<Way> follow(const Ray* rays, const Hit* closest, std::size_t count,
    const std::function<TriangleId(std::size_t)>& targetOf, double end = 1) const
  {
    std::vector<Way> ways(count);
    std::transform(
      closest, closest + count, ways.begin(), [](const Hit& hit) { return Way{ hit }; });
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

private:
  /// The part that goes straight through; 0 if that is no clear sheet.
  double passing(const TriangleId& sheet, const Vector3& direction) const
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
};

}
