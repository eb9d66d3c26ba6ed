// SPDX-License-Identifier: BSD-3-Clause
#include "Input/CoveredLamps.h"

#include "Sampling/WeightChoice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace irradiance
{

namespace
{

constexpr double kMuchCovered = 0.25;
constexpr std::size_t kTargets = 512, kRaysOfAll = 65536, kFewestRaysOfPart = 32;

/// The lights of a part, and what they emit up to and including each.
struct LampPart
{
  std::vector<const Light*> lights;
  std::vector<double> watts;
};

/// Points of a unit square or cube that fill it evenly (Roberts 2018).
std::array<double, 3> evenPoint(std::size_t i)
{
  const auto part = [i](double step) {
    const double turns = 0.5 + step * static_cast<double>(i);
    return turns - std::floor(turns);
  };
  return { part(0.8191725133961645), part(0.6710436067037893), part(0.5497004779019703) };
}

/// Calls visit(triangle in the world, its id) for all that are no lamps.
template <class Visit>
void forEachDark(const SceneObjects& objects, const CancelPoint& cancelPoint, const Visit& visit)
{
  ThrottledCancelPoint pace(cancelPoint);
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    const SceneObject& placed = objects[object];
    for (std::uint32_t i = 0; !placed.isEmpty() && i < placed.mesh().size(); ++i)
    {
      pace.step();
      if (!placed.isLamp(i))
      {
        visit(transformed(placed.worldFromObject, placed.mesh()[i]));
      }
    }
  }
}

/// Points that are even over the area of all surfaces that are no lamps.
struct Targets
{
  Targets(const SceneObjects& objects, const CancelPoint& cancelPoint)
  {
    double area = 0, before = 0;
    forEachDark(objects, cancelPoint, [&](const Triangle& triangle) { area += triangle.area(); });
    patch = area / kTargets;
    forEachDark(objects, cancelPoint, [&](const Triangle& triangle) {
      before += triangle.area();
      while (
        points.size() < kTargets && (static_cast<double>(points.size()) + 0.5) * patch < before)
      {
        const std::array<double, 3> u = evenPoint(points.size());
        points.push_back(surfacePoint(triangle, sampleTriangle({ u[0], u[1] })));
      }
    });
  }

  std::vector<SurfacePoint> points;
  double patch = 0; ///< m2, for which each stands
};

/// The power that 1 W at a place of a light brings to a patch around a point of a surface; 0 if
/// none can come.
double broughtBy(const LightPlace& from, const SurfacePoint& target, double patch)
{
  const Vector3 along = target.position - from.position();
  const double squared = along.squaredNorm();
  return std::max(0.0, from.leaving(target.position)) * from.perSteradian(target) *
    std::abs(target.normal.dot(along)) / std::sqrt(squared) / (squared + patch);
}

/// The ray from a place of the part, which `number` chooses, to a target, and what it brings.
std::pair<Ray, double> rayOf(const LampPart& part, std::size_t number, const Targets& targets)
{
  const std::array<double, 3> u = evenPoint(number);
  const Light& light = *part.lights[placeByWeight(part.watts, u[2] * part.watts.back())];
  const SurfacePoint& target = targets.points[number * 197 % targets.points.size()];
  const LightPlace from = light.place(sampleTriangle({ u[0], u[1] }));
  const Vector3 origin = from.origin();
  const Ray ray{ origin, target.position - origin, light.triangle() };
  return { ray, broughtBy(from, target, targets.patch) };
}

/// Follows the rays of a part.
CoveredLamps measured(
  const IrradianceEngine& engine, const LampPart& part, const Targets& targets, std::size_t count)
{
  CoveredLamps result{ part.lights.front()->cell, {}, part.watts.back(), 0 };
  double all = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto [ray, brought] = rayOf(part, i, targets);
    if (!(brought > 0))
    {
      continue;
    }
    const Hit hit =
      engine.frame().contacts.resolveContact(engine.scene(), ray, engine.scene().cast(ray));
    all += brought;
    if (!hit)
    {
      continue;
    }
    const SceneObject& object = engine.objects()[hit.id.object];
    if (object.isLamp(hit.id.triangle) &&
      engine.scene().worldTriangle(hit.id).areaVector().dot(ray.direction) > 0)
    {
      result.covered += brought;
      result.cover = { hit.id.object, object.material->cellOfTriangle[hit.id.triangle] };
    }
  }
  result.covered = all > 0 ? result.covered / all : 0;
  return result;
}

}

std::vector<CoveredLamps> findCoveredLamps(
  const LightGroup& group, bool areOthers, const CancelPoint& cancelPoint)
{
  const IrradianceEngine& engine = *group.engine;
  std::map<std::pair<std::uint32_t, std::uint32_t>, LampPart> parts;
  std::size_t lights = 0;
  for (const WalkSet& set : engine.walks().sets())
  {
    // Dynamic cells have the lights of the static ones.
    for (std::size_t i = 0; !set.source().isDynamic() && i < set.lights().lights().size(); ++i)
    {
      const Light& light = set.lights()[i];
      if (light.distant())
      {
        continue;
      }
      const std::uint32_t object = light.cell.object;
      LampPart& part =
        parts[{ object, engine.objects()[object].material->partOfCell(light.cell.cell) }];
      part.lights.push_back(&light);
      double watts = part.watts.empty() ? 0 : part.watts.back();
      for (int band = 0; band < Power::kMaxBands; ++band)
      {
        watts += group.shown(light.flux[static_cast<std::size_t>(band)], band);
      }
      part.watts.push_back(watts);
      ++lights;
    }
  }
  if (lights == 0 || (lights == 1 && !areOthers))
  {
    return {};
  }
  std::vector<CoveredLamps> covered;
  const Targets targets(engine.objects(), cancelPoint);
  const std::size_t count =
    std::max(kFewestRaysOfPart, std::min(kTargets, kRaysOfAll / parts.size()));
  for (const auto& [key, part] : parts)
  {
    cancelPoint();
    if (targets.points.empty())
    {
      continue;
    }
    if (const auto its = measured(engine, part, targets, count); its.covered >= kMuchCovered)
    {
      covered.push_back(its);
    }
  }
  return covered;
}

}
