// SPDX-License-Identifier: BSD-3-Clause
#include "FinalGather/GatherPaths.h"

#include "FinalGather/CellPoints.h"
#include "Sampling/DirectionSampling.h"
#include "Sampling/SobolPoint.h"
#include "Shooting/WalkSampler.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <stdexcept>

namespace irradiance
{

namespace
{

/// A path that needs more is in a closed part of the scene that absorbs nothing: it would never end.
constexpr std::uint32_t kMostBounces = 1u << 20;

enum class Use : std::uint64_t
{
  Position,
  Direction,
  Survival,
  Acceptance,
  Compensation
};

SampleKeys keysOf(std::uint64_t seed, std::uint32_t bounce, Use use)
{
  return SampleKeys(
    splitMix(seed ^ splitMix(std::uint64_t{ bounce } << 8 | static_cast<std::uint64_t>(use))));
}

/// What rounding does to rays is bounded for those that start near the scene: one that comes from afar starts again
/// where it is as near as the scene is wide.
Vector3 nearestOrigin(const Box& bounds, const Vector3& origin, const Vector3& direction)
{
  double along = 0;
  for (int axis = 0; !bounds.isEmpty() && axis < 3; ++axis)
  {
    const double pad = bounds.extent().maxCoeff();
    const double gap = std::max(bounds.lower[axis] - pad - origin[axis], 0.0) +
      std::min(bounds.upper[axis] + pad - origin[axis], 0.0);
    along = gap * direction[axis] > 0 ? std::max(along, gap / direction[axis]) : along;
  }
  return origin + along * direction;
}

/// Of a side or a point.
std::uint64_t seedOf(const GatherScene& scene, std::uint64_t number)
{
  return splitMix(scene.seed ^ splitMix(number));
}

std::array<float, 3> inFloats(const Vector3& v)
{
  return { static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()) };
}

double largestOf(const GatherPaths::Bands& weight)
{
  return *std::max_element(weight.begin(), weight.end());
}

/// The part of the largest weight that is left; of one band exactly its reflectance.
double reflectedPart(const GatherPaths::Bands& weight, const double* reflectances, int bands)
{
  GatherPaths::Bands reflected{};
  for (int band = 0; band < bands; ++band)
  {
    const auto i = static_cast<std::size_t>(band);
    reflected[i] = weight[i] * reflectances[i];
  }
  return bands == 1 ? reflectances[0] : std::min(1.0, largestOf(reflected) / largestOf(weight));
}

}

void GatherPaths::begin(const GatherScene& scene)
{
  bands_ = scene.known.all.bands();
  bounce_ = 0;
  numberOfPaths_ = 0;
  paths_.clear();
  rays_.clear();
  steps_.clear();
  values_.clear();
}

void GatherPaths::addSide(const GatherScene& scene, std::size_t cell, bool isFront,
  std::uint64_t number, const std::vector<std::uint32_t>& rays)
{
  const std::uint64_t seed = seedOf(scene, number);
  const SampleKeys places = keysOf(seed, 0, Use::Position),
                   directions = keysOf(seed, 0, Use::Direction);
  const CellPoints points(scene, cell);
  addStart(scene, seed, rays, [&](std::uint32_t i) {
    auto [point, id] = points.at(SobolPoint::inUnitSquare(i, places));
    point.turn(isFront);
    return Ray{ point.clearPosition(),
      sampleHemisphere(point.normal, SobolPoint::inUnitSquare(i, directions)), id };
  });
}

void GatherPaths::addPoint(const GatherScene& scene, const LitPoint& point, std::uint64_t number)
{
  std::vector<std::uint32_t> all(scene.rays);
  std::iota(all.begin(), all.end(), 0u);
  addPoint(scene, point, number, all);
}

void GatherPaths::addPoint(const GatherScene& scene, const LitPoint& point, std::uint64_t number,
  const std::vector<std::uint32_t>& rays)
{
  const std::uint64_t seed = seedOf(scene, number);
  const SampleKeys directions = keysOf(seed, 0, Use::Direction);
  addStart(scene, seed, rays, [&](std::uint32_t i) {
    const std::array<double, 2> u = SobolPoint::inUnitSquare(i, directions);
    const Vector3 direction =
      point.hasNormal() ? sampleHemisphere(point.normal, u) : sampleSphere(u);
    return Ray{ nearestOrigin(scene.space.scene.bounds(), point.position, direction), direction,
      point.on };
  });
}

template <class RayOf>
void GatherPaths::addStart(const GatherScene& scene, std::uint64_t seed,
  const std::vector<std::uint32_t>& rays, const RayOf& rayOf)
{
  Bands weight{};
  std::fill_n(weight.begin(), bands_, 1.0 / scene.raysOfReplicate());
  for (const std::uint32_t i : rays)
  {
    rays_.push_back(rayOf(i));
    paths_.push_back({ weight, seed, i, numberOfPaths_++, false });
  }
}

void GatherPaths::run(const GatherScene& scene)
{
  while (!paths_.empty())
  {
    cast(scene);
    if (++bounce_ > kMostBounces)
    {
      throw std::runtime_error("a path of the final gather does not end: the light cannot leave a "
                               "part of the scene that absorbs nothing (reflectance 1)");
    }
    next_.clear();
    nextRays_.clear();
    for (std::size_t i = 0; i < paths_.size(); ++i)
    {
      if (const Hit& hit = hits_[i])
      {
        const Arrival arrival = arrivalOf(scene, rays_[i], hit);
        record(scene, paths_[i], rays_[i], arrival);
        goOn(scene, paths_[i], rays_[i], arrival);
      }
      else
      {
        recordMiss(scene, paths_[i], rays_[i]);
      }
    }
    paths_.swap(next_);
    rays_.swap(nextRays_);
  }
  sortSteps();
}

void GatherPaths::sortSteps()
{
  std::vector<std::uint32_t> ends(numberOfPaths_ + 1), order(steps_.size());
  for (const Step& step : steps_)
  {
    ++ends[step.path + 1];
  }
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<std::uint32_t> next(ends.begin(), ends.end() - 1);
  for (std::uint32_t i = 0; i < steps_.size(); ++i)
  {
    order[next[steps_[i].path]++] = i;
  }
  followed_.clear();
  followed_.reserve(numberOfPaths_, steps_.size(), values_.size());
  for (std::uint32_t path = 0; path < numberOfPaths_; ++path)
  {
    for (std::uint32_t i = ends[path]; i < ends[path + 1]; ++i)
    {
      const std::uint32_t step = order[i];
      followed_.addSegment(steps_[step].segment);
      const std::size_t end = step + 1 < steps_.size() ? steps_[step + 1].value : values_.size();
      for (std::size_t value = steps_[step].value; value < end; ++value)
      {
        followed_.addValue(values_[value]);
      }
    }
    followed_.endPath();
  }
}

void GatherPaths::cast(const GatherScene& scene)
{
  const Contacts& contacts = scene.space.contacts;
  hits_.assign(rays_.size(), {});
  scene.space.scene.cast(rays_.data(), rays_.size(), hits_.data());
  for (std::size_t i = 0; !contacts.isEmpty() && i < rays_.size(); ++i)
  {
    if (contacts.has(rays_[i].start) || contacts.has(hits_[i].id))
    {
      hits_[i] = contacts.resolveContact(scene.space.scene, rays_[i], hits_[i]);
    }
  }
}

GatherPaths::Arrival GatherPaths::arrivalOf(
  const GatherScene& scene, const Ray& ray, const Hit& hit)
{
  const SceneTriangles& triangles = scene.space.triangles;
  const std::size_t cell = scene.objects[hit.id.object].material->cellOfTriangle[hit.id.triangle];
  const Vector3 normal = triangleOf(triangles, triangles.numberOf(hit.id)).areaVector();
  const int side = normal.dot(ray.direction) < 0 ? 0 : 1;
  Arrival arrival{ { { hit.id.object, cell }, side }, 0, false, false, hit };
  arrival.area = scene.cells.area(arrival.side);
  const bool isRead = scene.roles.isRead(arrival.side);
  const bool isNear = hit.distance * hit.distance < arrival.area;
  arrival.isKnown = isRead && !isNear;
  arrival.isUnknown = isRead ? isNear : !scene.known.direct;
  return arrival;
}

void GatherPaths::record(
  const GatherScene& scene, const Path& path, const Ray& ray, const Arrival& arrival)
{
  const Contacts& contacts = scene.space.contacts;
  const bool touchesMover = contacts.hasDynamic(ray.start) || contacts.hasDynamic(arrival.hit.id);
  steps_.push_back({ path.place,
    { inFloats(ray.origin), inFloats(ray.origin + arrival.hit.distance * ray.direction),
      scene.space.triangles.numberOf(arrival.hit.id), arrival.isFront(), path.isSpecular,
      arrival.isKnown, arrival.isUnknown, touchesMover },
    values_.size() });
  if (bands_ > 1)
  {
    values_.insert(values_.end(), path.weight.begin(), path.weight.begin() + bands_);
  }
  if (arrival.isUnknown)
  {
    askLights(scene, path, arrival);
  }
}

void GatherPaths::recordMiss(const GatherScene& scene, const Path& path, const Ray& ray)
{
  GatherSegment segment{};
  segment.from = inFloats(ray.origin);
  segment.to = inFloats(ray.direction);
  segment.triangle = GatherSegment::kNone;
  segment.touchesMover = scene.space.contacts.hasDynamic(ray.start);
  steps_.push_back({ path.place, segment, values_.size() });
}

void GatherPaths::askLights(const GatherScene& scene, const Path& path, const Arrival& arrival)
{
  const Material& material = *scene.objects[arrival.side.object].material;
  const std::uint64_t number =
    splitMix(path.seed ^ splitMix(std::uint64_t{ bounce_ } << 32 | path.number));
  const SurfacePoint at = scene.space.scene.surfaceOf(arrival.hit, arrival.isFront());
  const LitPoint point{ at.clearPosition(), at.normal, arrival.hit.id };
  Bands arriving{};
  for (const PointDirectLight& lights : scene.lights)
  {
    const PointDirectLight::Bands more = lights.irradiance(point, number);
    std::transform(
      more.begin(), more.end(), arriving.begin(), arriving.begin(), std::plus<double>());
  }
  for (int band = 0; band < bands_; ++band)
  {
    const auto i = static_cast<std::size_t>(band);
    values_.push_back(
      path.weight[i] * material.reflectanceOf(arrival.hit.id.triangle, band) * arriving[i]);
  }
}

void GatherPaths::goOn(
  const GatherScene& scene, const Path& path, const Ray& ray, const Arrival& arrival)
{
  const Material& material = *scene.objects[arrival.side.object].material;
  const std::size_t cell = arrival.side.cell;
  const bool isSpecular = material.isSpecular(cell);
  if (arrival.isKnown && !isSpecular)
  {
    return; // all that it reflects is known
  }
  const std::size_t first = cell * static_cast<std::size_t>(bands_);
  const double* const diffuse = &material.reflectance[first];
  const double* const specular = isSpecular ? &material.specularReflectance[first] : nullptr;
  SurvivalProbabilities survival{ reflectedPart(path.weight, diffuse, bands_),
    specular ? reflectedPart(path.weight, specular, bands_) : 0.0 };
  const double scale = std::max(1.0, survival.total()); // of several bands, see Absorption.h
  survival.diffuse /= scale;
  survival.specular /= scale;
  const auto sample = [&](Use use) {
    return SobolPoint::inUnitSquare(path.number, keysOf(path.seed, bounce_, use));
  };
  const double chance = sample(Use::Survival)[0];
  if (!(chance < survival.total()))
  {
    return;
  }
  const Reflection reflection = survival.chosenBy(chance);
  const bool isDiffuse = reflection == Reflection::Diffuse;
  if (isDiffuse && arrival.isKnown)
  {
    return;
  }
  Path next = path;
  next.isSpecular = !isDiffuse;
  for (int band = 0; bands_ > 1 && band < bands_; ++band)
  {
    const auto i = static_cast<std::size_t>(band);
    next.weight[i] *= (isDiffuse ? diffuse : specular)[i] / survival.of(reflection);
  }
  const SurfacePoint point = scene.space.scene.surfaceOf(arrival.hit, arrival.isFront());
  const Vector3 direction = isDiffuse
    ? sampleHemisphere(point.normal, sample(Use::Direction))
    : material.lobeOf(cell).sample(point.normal, incomingDirection(point, ray.origin),
        { sample(Use::Direction), sample(Use::Acceptance)[0], sample(Use::Compensation) });
  nextRays_.push_back({ point.clearPosition(), direction, arrival.hit.id });
  next_.push_back(next);
}

}
