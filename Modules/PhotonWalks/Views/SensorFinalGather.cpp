// SPDX-License-Identifier: BSD-3-Clause
#include "Views/SensorFinalGather.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace irradiance
{

namespace
{

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// In sizes of the scene.
constexpr double kFarthest = 0x1p20;

/// Towards the middle of the bounds: 1 along each axis at their faces and beyond.
Vector3 inwards(const Box& bounds, const Vector3& position)
{
  const Vector3 half = 0.5 * bounds.extent(), away = bounds.center() - position;
  Vector3 direction = Vector3::Zero();
  for (int axis = 0; axis < 3; ++axis)
  {
    direction[axis] = half[axis] > 0 ? std::clamp(away[axis] / half[axis], -1.0, 1.0) : 0;
  }
  return direction;
}

/// Before anything is counted.
const IrradianceEngine& checked(const IrradianceEngine& engine)
{
  checkLights(engine.objects(), "the final gather at points");
  return engine;
}

}

Box boundsBesideLamps(const SceneObjects& objects)
{
  Box all, besideLamps;
  for (std::uint32_t number = 0; number < objects.size(); ++number)
  {
    const SceneObject& object = objects[number];
    all.add(object.worldBounds());
    if (!object.emission)
    {
      besideLamps.add(object.worldBounds());
      continue;
    }
    for (std::uint32_t i = 0; i < object.mesh().size(); ++i)
    {
      if (!object.isLamp(i))
      {
        besideLamps.add(transformed(object.worldFromObject, object.mesh()[i]).bounds());
      }
    }
  }
  // Lamps that are not far away count: the walls of an oven may all be lamps.
  constexpr double kFar = 64; // sizes of the scene
  return all.extent().maxCoeff() <= kFar * besideLamps.extent().cwiseMax(0).maxCoeff() ||
      besideLamps.isEmpty()
    ? all
    : besideLamps;
}

double sensorClearance(const Box& near)
{
  return 0x1p-20 * near.size() + 0x1p-32 * near.magnitude();
}

std::optional<LitPoint> sensorPlace(const Box& bounds, const Box& near, const Sensor& sensor)
{
  LitPoint place{ sensor.position, sensor.normal };
  if (bounds.isEmpty())
  {
    return place;
  }
  const Vector3 away = (bounds.lower - sensor.position).cwiseMax(sensor.position - bounds.upper);
  if (away.maxCoeff() > kFarthest * bounds.extent().maxCoeff())
  {
    return std::nullopt;
  }
  const Vector3 off = place.hasNormal() ? sensor.normal : inwards(near, sensor.position);
  place.position += sensorClearance(near) * off;
  return place;
}

std::deque<PointDirectLight> gatheredLightsOf(const IrradianceEngine& engine)
{
  constexpr std::uint32_t kSamples = 64;
  return lightsOf(engine.walks(), engine.frame(), engine.settings().seed, kSamples, Asked::Gathered,
    LampChoice::kMostOfPoint);
}

Bands directLightAt(const Foot& foot, std::uint64_t number,
  const std::deque<PointDirectLight>& lights, const Scene& scene)
{
  const LitPoint point =
    LitPoint::onTriangle(scene.worldTriangle(foot.id), foot.id, foot.isFront, foot.sensor.position);
  Bands sum{};
  for (const PointDirectLight& some : lights)
  {
    sum += some.irradiance(point, number);
  }
  return sum;
}

SensorFinalGather::SensorFinalGather(
  const IrradianceEngine& engine, std::uint32_t rays, Execution& execution, bool keepsRays)
  : near_(boundsBesideLamps(engine.objects()))
  , noShapes_(engine.frame(), 0, 0)
  , gather_(checked(engine), noShapes_, rays, false, keepsRays, execution)
  , direct_(lightsOf(engine.walks(), engine.frame(), engine.settings().seed, gather_.scene().rays,
      Asked::All, LampChoice::kMostOfPoint))
{
}

std::vector<SensorFinalGather::Replicates> SensorFinalGather::update(
  const std::vector<Sensor>& sensors, const std::vector<std::size_t>& numbers,
  const FinalGatherMotion* motion, Rays& rays, std::int64_t& cast) const
{
  Rays now{ startsOf(sensors, numbers, motion, rays.starts), {} };
  now.paths = pathsOf(now.starts, numbers, motion, rays, cast);
  rays = std::move(now);
  const PathSums brought(scene(), rays.paths);
  Bands unknown{};
  unknown.fill(kUnknown);
  std::vector<Replicates> found;
  std::size_t path = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    Rays::Start& start = rays.starts[i];
    if (!start.place)
    {
      found.emplace_back(scene().replicates(), unknown);
      continue;
    }
    askLights(start, numbers[i], motion, cast);
    // Radiance is radiosity / pi; the density of rays is cos(theta) / pi, or 1 / (4 pi).
    Replicates replicates = gather_.replicatesOf(brought, path++, start.place->hasNormal() ? 1 : 4);
    for (std::size_t k = 0; k < replicates.size(); ++k)
    {
      replicates[k] += start.direct[k];
    }
    found.push_back(std::move(replicates));
  }
  return found;
}

std::vector<SensorFinalGather::Rays::Start> SensorFinalGather::startsOf(
  const std::vector<Sensor>& sensors, const std::vector<std::size_t>& numbers,
  const FinalGatherMotion* motion, std::vector<Rays::Start>& before) const
{
  std::vector<Rays::Start> starts;
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    const Box& bounds = scene().frame.scene.bounds();
    Rays::Start start{ sensorPlace(bounds, near_, sensors[numbers[i]]) };
    start.isInside = start.place && (bounds.lower.array() <= start.place->position.array()).all() &&
      (start.place->position.array() <= bounds.upper.array()).all();
    // Outside of the bounds paths do not start at the sensor, but where the bounds say.
    if (motion && i < before.size() && start.place && before[i].place &&
      start.place->position == before[i].place->position &&
      start.place->normal == before[i].place->normal &&
      (motion->isNone() || (start.isInside && before[i].isInside)))
    {
      start.isKept = true;
      start.shadows = std::move(before[i].shadows);
      start.direct = std::move(before[i].direct);
    }
    starts.push_back(std::move(start));
  }
  return starts;
}

FollowedPaths SensorFinalGather::pathsOf(const std::vector<Rays::Start>& starts,
  const std::vector<std::size_t>& numbers, const FinalGatherMotion* motion, const Rays& before,
  std::int64_t& cast) const
{
  std::vector<std::size_t> places;
  FollowedPaths anew = gather_.follow([&](FinalGatherPaths& paths) {
    std::size_t first = 0; // before, of the paths of the start
    std::vector<std::uint32_t> rays;
    for (std::size_t i = 0; i < starts.size(); ++i)
    {
      rays.clear();
      for (std::uint32_t ray = 0; starts[i].place && ray < scene().rays; ++ray)
      {
        const bool isAnew = !starts[i].isKept || motion->mayChange(before.paths[first + ray]);
        places.push_back(isAnew ? FollowedPaths::kAnew : first + ray);
        if (isAnew)
        {
          rays.push_back(ray);
        }
      }
      if (!rays.empty())
      {
        paths.addPoint(*starts[i].place, numbers[i], rays);
      }
      first += i < before.starts.size() && before.starts[i].place ? scene().rays : 0;
    }
  });
  cast += static_cast<std::int64_t>(anew.size());
  return anew.size() == places.size() ? anew : anew.mergedWith(before.paths, places);
}

void SensorFinalGather::askLights(
  Rays::Start& start, std::size_t number, const FinalGatherMotion* motion, std::int64_t& cast) const
{
  const auto mayChange = [&](const ShadowRay& ray) { return motion->mayChange(ray); };
  if (start.isKept &&
    std::none_of(start.shadows.begin(), start.shadows.end(),
      [&](const auto& group) { return std::any_of(group.begin(), group.end(), mayChange); }))
  {
    return;
  }
  start.shadows.resize(direct_.size());
  start.direct.assign(scene().replicates(), Bands{});
  for (std::size_t i = 0; i < direct_.size(); ++i)
  {
    cast += direct_[i].update(*start.place, number, mayChange, start.shadows[i], start.direct);
  }
}

std::size_t SensorFinalGather::Rays::bytes() const
{
  std::size_t bytes = paths.bytes() + starts.capacity() * sizeof(Start);
  for (const Start& start : starts)
  {
    bytes += start.direct.capacity() * sizeof(Bands);
    for (const std::vector<ShadowRay>& group : start.shadows)
    {
      bytes += sizeof(std::vector<ShadowRay>) + group.capacity() * sizeof(ShadowRay);
    }
  }
  return bytes;
}

SensorFinalGather::Light SensorFinalGather::lightOf(const Replicates& replicates)
{
  Light light{};
  std::vector<double> parts(replicates.size());
  for (std::size_t band = 0; band < light.value.size(); ++band)
  {
    std::transform(replicates.begin(), replicates.end(), parts.begin(),
      [band](const Bands& replicate) { return replicate[band]; });
    light.value[band] = std::accumulate(parts.begin(), parts.end(), 0.0);
    light.standardError[band] = standardErrorOf(parts);
  }
  return light;
}

}
