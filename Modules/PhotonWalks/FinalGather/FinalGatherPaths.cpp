// SPDX-License-Identifier: BSD-3-Clause
#include "FinalGather/FinalGatherPaths.h"

#include "Sampling/DirectionSampling.h"
#include "Sampling/SobolPoint.h"
#include "Shooting/WalkStages.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <stdexcept>

namespace irradiance
{

namespace
{

/// A path that needs more is in a closed part of the scene that absorbs nothing: it would never
/// end.
constexpr std::uint32_t kMostBounces = 1u << 20;

/// Points that fill the area of a cell evenly.
class AreaPoints
{
public:
  /// `cell`: of the shapes; it has an area.
  AreaPoints(const CellShapes& shapes, const SceneTriangles& triangles, std::size_t cell)
  {
    std::for_each(shapes.begin(cell), shapes.end(cell), [&](std::uint32_t number) {
      const Triangle triangle = triangleOf(triangles, number);
      parts_.push_back({ triangle, triangle.area(), triangles.idOf(number) });
      area_ += parts_.back().area;
    });
  }

  /// On the front, with its triangle. `u`: of the unit square.
  std::pair<SurfacePoint, TriangleId> at(std::array<double, 2> u) const
  {
    double before = u[0] * area_;
    auto part = parts_.begin();
    while (before >= part->area && part + 1 != parts_.end())
    {
      before -= part->area;
      ++part;
    }
    // What the choice left of it. Rounding may lead to a last triangle without area.
    u[0] = part->area > 0 ? std::clamp(before / part->area, 0x1p-53, 1 - 0x1p-53) : 0.5;
    return { surfacePoint(part->triangle, sampleTriangle(u)), part->id };
  }

private:
  struct Part
  {
    Triangle triangle;
    double area; ///< m2
    TriangleId id;
  };
  std::vector<Part> parts_;
  double area_ = 0; ///< m2
};

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

/// Of a ray of a start.
std::array<double, 2> sampleOf(
  std::uint64_t seed, std::uint32_t number, std::uint32_t bounce, Use use)
{
  return SobolPoint::inUnitSquare(number, keysOf(seed, bounce, use));
}

/// What rounding does to rays is bounded for those that start near the scene: one that comes from
/// afar starts again where it is as near as the scene is wide.
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
std::uint64_t seedOf(const FinalGatherScene& scene, std::uint64_t number)
{
  return splitMix(scene.seed ^ splitMix(number));
}

double cosineOf(const PathVertex& vertex)
{
  return -vertex.incoming.dot(vertex.point.normal);
}

/// The part of the largest weight that is left; of one band exactly its reflectance.
double reflectedPart(const Bands& weight, const double* reflectances, int bands)
{
  Bands reflected{};
  for (int band = 0; band < bands; ++band)
  {
    const auto i = static_cast<std::size_t>(band);
    reflected[i] = weight[i] * reflectances[i];
  }
  return bands == 1 ? reflectances[0] : std::min(1.0, reflected.largest() / weight.largest());
}

}

void FinalGatherPaths::begin(const FinalGatherScene& scene)
{
  scene_ = &scene;
  bands_ = scene.known.bands();
  bounce_ = 0;
  numberOfPaths_ = 0;
  paths_.clear();
  rays_.clear();
  steps_.clear();
  values_.clear();
  shadows_.clear();
}

void FinalGatherPaths::addSide(
  std::size_t cell, bool isFront, std::uint64_t number, const std::vector<std::uint32_t>& rays)
{
  const std::uint64_t seed = seedOf(*scene_, number);
  const SampleKeys places = keysOf(seed, 0, Use::Position),
                   directions = keysOf(seed, 0, Use::Direction);
  const AreaPoints points(scene_->shapes, scene_->frame.triangles, cell);
  for (const std::uint32_t i : rays)
  {
    auto [point, id] = points.at(SobolPoint::inUnitSquare(i, places));
    point.turn(isFront);
    rays_.push_back({ point.clearPosition(),
      sampleHemisphere(point.normal, SobolPoint::inUnitSquare(i, directions)), id });
    paths_.push_back(startOf(seed, i));
  }
}

void FinalGatherPaths::addPoint(
  const LitPoint& point, std::uint64_t number, const std::vector<std::uint32_t>& rays)
{
  const std::uint64_t seed = seedOf(*scene_, number);
  const SampleKeys directions = keysOf(seed, 0, Use::Direction);
  for (const std::uint32_t i : rays)
  {
    const std::array<double, 2> u = SobolPoint::inUnitSquare(i, directions);
    const Vector3 direction =
      point.hasNormal() ? sampleHemisphere(point.normal, u) : sampleSphere(u);
    rays_.push_back({ nearestOrigin(scene_->frame.scene.bounds(), point.position, direction),
      direction, point.on });
    paths_.push_back(startOf(seed, i));
  }
}

void FinalGatherPaths::addSpecular(std::size_t cell, std::uint64_t number, const ToEye& toEye)
{
  const std::uint64_t seed = seedOf(*scene_, number);
  const SampleKeys places = keysOf(seed, 0, Use::Position);
  const AreaPoints points(scene_->shapes, scene_->frame.triangles, cell);
  for (std::uint32_t i = 0; i < scene_->rays; ++i)
  {
    const Path path = startOf(seed, i);
    auto [place, id] = points.at(SobolPoint::inUnitSquare(i, places));
    const Vector3 eye = toEye(place.position);
    place.turn(eye.dot(place.normal) >= 0);
    const Material& material = *scene_->frame.objects[id.object].material;
    const PhongLobe& lobe = material.lobeOf(material.cellOfTriangle[id.triangle]);
    if (lobe.isMirror() ? !eye.isZero(0) : eye.dot(place.normal) > 0)
    {
      const PathVertex vertex{ { place.clearPosition(), place.normal, id }, -eye };
      if (!lobe.isMirror())
      {
        recordStart(path, place.position, vertex, lobe);
      }
      goOnSpecularly(path, vertex, lobe, paths_, rays_);
    }
  }
}

FinalGatherPaths::Path FinalGatherPaths::startOf(std::uint64_t seed, std::uint32_t ray)
{
  Path path{ {}, seed, ray, numberOfPaths_++, false, false, kInfinity };
  std::fill_n(path.weight.begin(), bands_, 1.0 / scene_->raysOfReplicate());
  return path;
}

FollowedPaths FinalGatherPaths::run(FollowedPaths memory)
{
  while (!paths_.empty())
  {
    cast();
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
        const Arrival arrival = arrivalOf(rays_[i], hit);
        record(paths_[i], rays_[i], arrival);
        goOn(paths_[i], rays_[i], arrival);
      }
      else
      {
        PathSegment segment{};
        segment.from = inFloats(rays_[i].origin);
        segment.to = inFloats(rays_[i].direction);
        segment.triangle = SceneTriangles::kNone;
        segment.isSpecular = paths_[i].isSpecular;
        segment.isStraight = paths_[i].isStraight;
        segment.touchesMover = scene_->frame.contacts.hasDynamic(rays_[i].start);
        addStep(paths_[i], segment);
      }
    }
    paths_.swap(next_);
    rays_.swap(nextRays_);
  }
  return sorted(std::move(memory));
}

FollowedPaths FinalGatherPaths::sorted(FollowedPaths memory)
{
  std::vector<std::uint32_t> ends(numberOfPaths_ + 1), order(steps_.size());
  for (const Step& step : steps_)
  {
    ++ends[step.path + 1];
  }
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<std::uint32_t> places(ends.begin(), ends.end() - 1);
  for (std::uint32_t i = 0; i < steps_.size(); ++i)
  {
    order[places[steps_[i].path]++] = i;
  }
  FollowedPaths followed = std::move(memory);
  followed.clear(numberOfPaths_, steps_.size(), values_.size());
  steps_.push_back({ numberOfPaths_, {}, values_.size(), shadows_.size() }); // where the last ends
  for (std::uint32_t path = 0; path < numberOfPaths_; ++path)
  {
    for (std::uint32_t i = ends[path]; i < ends[path + 1]; ++i)
    {
      const Step &step = steps_[order[i]], &next = steps_[order[i] + 1];
      followed.addSegment(step.segment, values_.data() + step.value, values_.data() + next.value,
        shadows_.data() + step.shadow, shadows_.data() + next.shadow);
    }
    followed.endPath();
  }
  return followed;
}

void FinalGatherPaths::cast()
{
  const Contacts& contacts = scene_->frame.contacts;
  hits_.assign(rays_.size(), {});
  scene_->frame.scene.cast(rays_.data(), rays_.size(), hits_.data());
  for (std::size_t i = 0; !contacts.isEmpty() && i < rays_.size(); ++i)
  {
    if (contacts.has(rays_[i].start) || contacts.has(hits_[i].id))
    {
      hits_[i] = contacts.resolveContact(scene_->frame.scene, rays_[i], hits_[i]);
    }
  }
}

FinalGatherPaths::Arrival FinalGatherPaths::arrivalOf(const Ray& ray, const Hit& hit) const
{
  const SceneTriangles& triangles = scene_->frame.triangles;
  const Material& material = *scene_->frame.objects[hit.id.object].material;
  const std::size_t cell = material.cellOfTriangle[hit.id.triangle];
  const Vector3 normal = triangleOf(triangles, triangles.numberOf(hit.id)).areaVector();
  const int side = normal.dot(ray.direction) < 0 ? 0 : 1;
  const bool asksLobe =
    scene_->asksOnLobes && material.isSpecular(cell) && !material.lobeOf(cell).isMirror();
  Arrival arrival{ { { hit.id.object, cell }, side }, false, false,
    asksLobe ? &material.lobeOf(cell) : nullptr, hit };
  const bool isLarge = scene_->roles.isRead(arrival.side),
             isRead = isLarge && scene_->isRead(arrival.side);
  const bool isNear = hit.distance * hit.distance < scene_->frame.cells.area(arrival.side);
  arrival.isKnown = isRead && !isNear;
  arrival.isUnknown = isLarge ? isNear || !isRead : !scene_->knownDirect;
  return arrival;
}

PathVertex FinalGatherPaths::vertexOf(const Ray& ray, const Arrival& arrival) const
{
  const SurfacePoint place = scene_->frame.scene.surfaceOf(arrival.hit, arrival.isFront());
  return { { place.clearPosition(), place.normal, arrival.hit.id },
    incomingDirection(place, ray.origin) };
}

void FinalGatherPaths::record(const Path& path, const Ray& ray, const Arrival& arrival)
{
  const Contacts& contacts = scene_->frame.contacts;
  const TriangleId& id = arrival.hit.id;
  const SceneObject& object = scene_->frame.objects[id.object];
  const Vector3 to = ray.origin + arrival.hit.distance * ray.direction;
  const bool asksLights = arrival.isUnknown || arrival.lobe;
  const bool hasLampWeight = path.isSpecular && !std::isinf(path.density) && arrival.isFront() &&
    object.hasExitance(object.material->cellOfTriangle[id.triangle]);
  addStep(path,
    { inFloats(ray.origin), inFloats(to), scene_->frame.triangles.numberOf(id), arrival.isFront(),
      path.isSpecular, path.isStraight, arrival.isKnown, !arrival.isKnown && !arrival.isUnknown,
      asksLights, hasLampWeight,
      contacts.hasDynamic(ray.start) || contacts.hasDynamic(id) || arrival.lobe != nullptr });
  if (asksLights)
  {
    askLights(path, vertexOf(ray, arrival), arrival);
  }
  if (hasLampWeight)
  {
    values_.push_back(lampWeight(*scene_, ray, path.density, id, to));
  }
}

void FinalGatherPaths::recordStart(
  const Path& path, const Vector3& place, const PathVertex& from, const PhongLobe& lobe)
{
  PathSegment segment{};
  segment.from = segment.to = inFloats(place);
  segment.triangle = scene_->frame.triangles.numberOf(from.point.on);
  segment.asksLights = true;
  addStep(path, segment);
  const Bands light = lobeLight(*scene_, from, lobe, path.seed, path.number);
  std::transform(light.begin(), light.begin() + bands_, path.weight.begin(),
    std::back_inserter(values_), std::multiplies<double>());
}

void FinalGatherPaths::addStep(const Path& path, const PathSegment& segment)
{
  steps_.push_back({ path.place, segment, values_.size(), shadows_.size() });
  if (bands_ > 1 && (segment.triangle != SceneTriangles::kNone || scene_->sky))
  {
    values_.insert(values_.end(), path.weight.begin(), path.weight.begin() + bands_);
  }
}

void FinalGatherPaths::askLights(const Path& path, const PathVertex& at, const Arrival& arrival)
{
  const Material& material = *scene_->frame.objects[at.point.on.object].material;
  const std::uint64_t number =
    splitMix(path.seed ^ splitMix(std::uint64_t{ bounce_ } << 32 | path.number));
  const bool asksDiffuse = arrival.isUnknown && material.reflectsDiffusely(arrival.side.cell),
             asksThrough = arrival.isUnknown && material.transmitsDiffusely(arrival.side.cell);
  Bands arriving{}, behind{}, onLobe{};
  for (const PointDirectLight& lights : scene_->lights)
  {
    std::vector<ShadowRay>* const shadows = scene_->keepsPaths ? &shadows_ : nullptr;
    if (asksDiffuse)
    {
      arriving += lights.irradiance(at.point, number, shadows);
    }
    if (asksThrough)
    {
      const SurfacePoint back = scene_->frame.scene.surfaceOf(arrival.hit, !arrival.isFront());
      behind += lights.irradiance(
        { back.clearPosition(), back.normal, at.point.on }, splitMix(number + 1), shadows);
    }
  }
  const Bands through =
    asksThrough ? material.partOf(Leaving::DiffuseThrough, arrival.side.cell, 1) * behind : Bands{};
  if (arrival.lobe)
  {
    onLobe = lobeLight(*scene_, at, *arrival.lobe, splitMix(number), 0);
  }
  for (int band = 0; band < bands_; ++band)
  {
    const auto i = static_cast<std::size_t>(band);
    double reflected =
      material.reflectanceOf(at.point.on.triangle, band) * arriving[i] + through[i];
    if (arrival.lobe)
    {
      reflected += material.specularOf(at.point.on.triangle, band) * onLobe[i];
    }
    values_.push_back(path.weight[i] * reflected);
  }
}

void FinalGatherPaths::goOn(const Path& path, const Ray& ray, const Arrival& arrival)
{
  const Material& material = *scene_->frame.objects[arrival.side.object].material;
  const std::size_t cell = arrival.side.cell;
  if (arrival.isKnown && !material.isSpecular(cell) && !material.transmitsStraight(cell))
  {
    return; // all that it sends is known
  }
  const double cosine = material.isPane(cell) ? cosineOf(vertexOf(ray, arrival)) : 1;
  const std::array<Bands, kLeavings> parts = material.partsOf(cell, cosine);
  SurvivalProbabilities survival;
  for (std::size_t way = 0; way < (material.hasOtherWays() ? kLeavings : 1); ++way)
  {
    survival.ways[way] = reflectedPart(path.weight, parts[way].data(), bands_);
  }
  const double sum = survival.total();
  for (std::size_t way = 0; sum > 1 && way < kLeavings; ++way) // several bands, see Absorption.h
  {
    survival.ways[way] /= sum;
  }
  const double chance = sampleOf(path.seed, path.number, bounce_, Use::Survival)[0];
  if (!(chance < survival.total()))
  {
    return;
  }
  const Leaving way = survival.at(chance);
  if (arrival.isKnown && !isSharp(way))
  {
    return;
  }
  Path next = path;
  for (int band = 0; bands_ > 1 && band < bands_; ++band)
  {
    const auto i = static_cast<std::size_t>(band);
    next.weight[i] *= parts[static_cast<std::size_t>(way)][i] / survival.of(way);
  }
  PathVertex vertex = vertexOf(ray, arrival);
  if (way == Leaving::Specular)
  {
    goOnSpecularly(next, vertex, material.lobeOf(cell), next_, nextRays_);
    return;
  }
  if (isThrough(way))
  {
    const SurfacePoint back = scene_->frame.scene.surfaceOf(arrival.hit, !arrival.isFront());
    vertex.point.position = back.clearPosition();
    vertex.point.normal = back.normal;
  }
  const bool goesStraight = way == Leaving::Straight;
  next.isStraight = goesStraight && material.isClear(cell);
  next.isSpecular = next.isStraight ? path.isSpecular : goesStraight;
  next.density = kInfinity;
  nextRays_.push_back({ vertex.point.position,
    goesStraight ? ray.direction
                 : sampleHemisphere(vertex.point.normal,
                     sampleOf(path.seed, path.number, bounce_, Use::Direction)),
    vertex.point.on });
  next_.push_back(next);
}

void FinalGatherPaths::goOnSpecularly(Path path, const PathVertex& from, const PhongLobe& lobe,
  std::vector<Path>& paths, std::vector<Ray>& rays) const
{
  const Vector3& normal = from.point.normal;
  const auto sample = [&](Use use) { return sampleOf(path.seed, path.number, bounce_, use); };
  const Vector3 direction = lobe.sample(normal, from.incoming,
    { sample(Use::Direction), sample(Use::Acceptance)[0], sample(Use::Compensation) });
  path.isSpecular = true;
  path.isStraight = false;
  path.density = scene_->asksOnLobes && !lobe.isMirror()
    ? lobe.value(normal, direction, -from.incoming) * direction.dot(normal)
    : kInfinity;
  paths.push_back(path);
  rays.push_back({ from.point.position, direction, from.point.on });
}

}
