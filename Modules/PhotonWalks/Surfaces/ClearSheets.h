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

/// Rays that look for lamps, and what is left of their light, as clear sheets let it go straight on.
struct ClearSheets
{
  const SceneObjects& objects;
  const Scene& scene;
  const Contacts* contacts = nullptr; ///< null: nothing coincides
  bool mayPass = true;                ///< else they stop rays as all else does

  /// Where a ray ends, and what clear sheets before leave.
  struct Way
  {
    Hit hit;
    double passed = 1;        ///< > 0, a multiple of 2^-24
    bool meetsMovers = false; ///< some of these sheets are dynamic
  };
  /// What stops each ray before its length is `end`, or is hit then. `targetOf`: by place, where it
  /// is to arrive.
  std::vector<Way> cast(const Ray* rays, std::size_t count,
    const std::function<TriangleId(std::size_t)>& targetOf, double end = 1) const
  {
    std::vector<Hit> next(count);
    scene.cast(rays, count, next.data());
    std::vector<Way> ways(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      const bool isContact = contacts && !contacts->isEmpty() &&
        (contacts->has(rays[i].start) || contacts->has(targetOf(i)));
      ways[i].hit = isContact ? contacts->resolveContact(scene, rays[i], next[i]) : next[i];
    }
    if (!mayPass)
    {
      return ways;
    }
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
      next.resize(rests.size());
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
