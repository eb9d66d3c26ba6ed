// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/FrontCast.h"

#include "Kernels/IntersectionLanes.h"
#include "Progress/StageTimes.h"

#include <algorithm>
#include <cmath>

namespace irradiance
{

namespace
{

TreeRays inWorld(const FrontRays& rays, std::uint32_t triangles)
{
  return { rays.count, { rays.origin[0], rays.origin[1], rays.origin[2] },
    { rays.direction[0], rays.direction[1], rays.direction[2] }, { nullptr, nullptr, nullptr },
    rays.start, 0, triangles, rays.distance, rays.hit, { rays.weight[0], rays.weight[1] } };
}

Ray rayOf(const FrontRays& rays, std::uint32_t ray)
{
  return { { rays.origin[0][ray], rays.origin[1][ray], rays.origin[2][ray] },
    { rays.direction[0][ray], rays.direction[1][ray], rays.direction[2][ray] }, {} };
}

/// Documentation/Theory.md, section 3, derives the constants.
EllipsoidFilter filterOf(const EllipsoidBound& bound)
{
  const EllipsoidBound::Ball ball = bound.ball();
  const double largest = ball.roundFromWorld.cwiseAbs().maxCoeff();
  const double scale = largest > 0 && std::isfinite(largest) ? std::exp2(std::ilogb(largest)) : 1;
  const Matrix3 map = ball.roundFromWorld / scale;
  const double condition = map.norm() * map.inverse().norm(); // not finite if nothing is rejected
  const double squared = ball.radius * ball.radius;
  EllipsoidFilter filter;
  filter.scale = scale;
  for (int row = 0; row < 3; ++row)
  {
    filter.center[row] = ball.center[row];
    for (int column = 0; column < 3; ++column)
    {
      filter.roundFromScaled[3 * row + column] = static_cast<float>(map(row, column));
    }
  }
  filter.squaredRadius =
    static_cast<float>(squared * (1 + 0x1p-6 + 0x1p-34 * condition * condition));
  filter.byDistance = static_cast<float>(0x1p-32 * map.squaredNorm());
  return filter;
}

CornerRows rowsOf(const SurfaceRecords& records)
{
  return { records.rows()->a, sizeof(SurfaceRecord) / sizeof(double) };
}

CornerRows rowsOf(const TriangleMesh& mesh)
{
  static_assert(sizeof(Triangle) == 9 * sizeof(double));
  return { mesh.triangles().data()->a.data(), 9 };
}

}

void FrontCast::cast(const Scene& scene, const SurfaceRecords& records, const FrontRays& rays)
{
  if (scene.mode_ == TraversalMode::OneTree && !scene.placed_.empty())
  {
    return castMixed(scene, scene.oneTree_, records, rays);
  }
  // Once a static hit is known, few of many bodies are before it.
  const bool isStaticFirst = scene.dynamic_.flattened || areMany(scene.dynamic_);
  if (isStaticFirst)
  {
    castStatic(scene, records, rays);
  }
  castDynamic(scene, records, rays);
  if (!isStaticFirst)
  {
    castStatic(scene, records, rays);
  }
}

void FrontCast::castDynamic(
  const Scene& scene, const SurfaceRecords& records, const FrontRays& rays)
{
  castGroup(scene, scene.dynamic_, records, rays);
}

void FrontCast::castMoved(const Scene& scene, const SurfaceRecords& records, const FrontRays& rays)
{
  castGroup(scene, scene.moved_, records, rays);
}

void FrontCast::castGroup(const Scene& scene, const Scene::Group& group,
  const SurfaceRecords& records, const FrontRays& rays)
{
  if (group.flattened)
  {
    castMixed(scene, *group.flattened, records, rays);
  }
  if (areMany(group))
  {
    return castBodies(scene, group, records, rays);
  }
  for (const std::uint32_t index : group.instanced)
  {
    castBody(scene, index, records, rays);
  }
}

bool FrontCast::areMany(const Scene::Group& group)
{
  return group.instanced.size() > kFewBodies && !group.bodies.isEmpty();
}

void FrontCast::castStatic(const Scene& scene, const SurfaceRecords& records, const FrontRays& rays)
{
  const auto triangles = static_cast<std::uint32_t>(scene.static_->mesh().size());
  if (triangles == 0)
  {
    return;
  }
  search_.run(*scene.static_, inWorld(rays, triangles), rowsOf(records));
}

void FrontCast::castMixed(const Scene& scene, const Scene::MixedTree& mixed,
  const SurfaceRecords& records, const FrontRays& rays)
{
  StageClock clock;
  start_.need(TreeRays::roomFor(rays.count));
  for (std::uint32_t ray = 0; ray < rays.count; ++ray)
  {
    start_[ray] = mixed.referenceTo(records.numbers().idOf(rays.start[ray]));
  }
  TreeRays world = inWorld(rays, static_cast<std::uint32_t>(mixed.ids.size()));
  world.start = start_.data();
  clock.ends(Stage::PreTest);
  tests_.clear();
  for (const auto& [ray, reference] : pairs_.find(mixed.tree, world))
  {
    const TriangleId& id = mixed.ids[reference];
    addTest(scene, ray, records.numbers().numberOf(id), id);
  }
  runTests(scene, records, rays);
}

void FrontCast::castBody(
  const Scene& scene, std::uint32_t index, const SurfaceRecords& records, const FrontRays& rays)
{
  StageClock clock;
  local_.need(TreeRays::roomFor(rays.count));
  const EllipsoidFilter filter = filterOf(scene.placed_[index].bound);
  const std::uint32_t count = pickFront(inWorld(rays, 0), filter, local_.ray.data());
  clock.ends(Stage::PreTest);
  castPicked(scene, index, records, rays, count);
}

void FrontCast::castBodies(const Scene& scene, const Scene::Group& group,
  const SurfaceRecords& records, const FrontRays& rays)
{
  const auto bodies = static_cast<std::uint32_t>(group.instanced.size());
  const std::vector<FrontPairs::Pair>& pairs = pairs_.find(group.bodies, inWorld(rays, 0));
  StageClock clock;
  raysOfBodies_.set(pairs, rays.count, bodies);
  local_.need(TreeRays::roomFor(rays.count));
  for (std::uint32_t body = 0; body < bodies; ++body)
  {
    const std::uint32_t index = group.instanced[body];
    std::uint32_t count = 0;
    raysOfBodies_.forEach(body, [&](std::uint32_t ray) {
      if (scene.mayTouch(scene.placed_[index], rayOf(rays, ray), rays.distance[ray]))
      {
        local_.ray[count++] = ray;
      }
    });
    clock.ends(Stage::PreTest);
    castPicked(scene, index, records, rays, count);
    clock = {};
  }
}

/// Casts the rays in `local_.ray`, so many, to a body.
void FrontCast::castPicked(const Scene& scene, std::uint32_t index, const SurfaceRecords& records,
  const FrontRays& rays, std::uint32_t count)
{
  if (count == 0)
  {
    return;
  }
  StageClock clock;
  const std::uint32_t object = index + 1;
  takeToBody(scene, object, rays, count);
  clock.ends(Stage::PreTest);
  const TriangleMesh& mesh = scene.meshOf(object);
  search_.run(scene.bodyOf(object),
    local_.columns(count, records.numbers().first(object), static_cast<std::uint32_t>(mesh.size())),
    rowsOf(mesh));
  giveBack(rays, count);
}

/// By the same operations as everywhere, so that hits have the same bits.
void FrontCast::takeToBody(
  const Scene& scene, std::uint32_t object, const FrontRays& rays, std::uint32_t count)
{
  for (std::uint32_t i = 0; i < count; ++i)
  {
    const std::uint32_t ray = local_.ray[i];
    const Scene::LocalRay local = scene.localRay(rayOf(rays, ray), object);
    for (int axis = 0; axis < 3; ++axis)
    {
      local_.origin[axis][i] = local.origin[axis];
      local_.direction[axis][i] = local.direction[axis];
    }
    local_.start[i] = rays.start[ray];
    local_.distance[i] = rays.distance[ray];
    local_.hit[i] = rays.hit[ray];
  }
}

void FrontCast::giveBack(const FrontRays& rays, std::uint32_t count)
{
  for (std::uint32_t i = 0; i < count; ++i)
  {
    const std::uint32_t ray = local_.ray[i];
    if (local_.hit[i] != rays.hit[ray] || local_.distance[i] != rays.distance[ray])
    {
      rays.distance[ray] = local_.distance[i];
      rays.hit[ray] = local_.hit[i];
      rays.weight[0][ray] = local_.weight[0][i];
      rays.weight[1][ray] = local_.weight[1][i];
    }
  }
}

void FrontCast::findDistances(
  const Scene& scene, const SurfaceRecords& records, const FrontRays& rays)
{
  StageClock clock;
  const auto triangles = static_cast<std::uint32_t>(scene.static_->mesh().size());
  const std::uint32_t room = TreeRays::roomFor(rays.count);
  candidate_.need(room);
  std::fill_n(candidate_.data() + rays.count, room - rays.count, TreeRays::kNone);
  std::fill_n(rays.distance, rays.count, kInfinity);
  tests_.clear();
  for (std::uint32_t ray = 0; ray < rays.count; ++ray)
  {
    const std::uint32_t hit = rays.hit[ray];
    const bool isStatic = hit < triangles;
    candidate_[ray] = isStatic ? hit : TreeRays::kNone;
    if (!isStatic && hit != TreeRays::kNone)
    {
      addTest(scene, ray, hit, records.numbers().idOf(hit));
    }
  }
  if (triangles > 0)
  {
    confirmFront(inWorld(rays, triangles), candidate_.data(), rowsOf(records));
  }
  clock.ends(Stage::Confirm);
  runTests(scene, records, rays);
}

/// Prefetches the triangle.
void FrontCast::addTest(
  const Scene& scene, std::uint32_t ray, std::uint32_t number, const TriangleId& id)
{
  scene.bodyOf(id.object).mesh().prefetch(id.triangle);
  tests_.push_back({ ray, number });
}

/// Tests what was added, and keeps the closer hits.
void FrontCast::runTests(const Scene& scene, const SurfaceRecords& records, const FrontRays& rays)
{
  StageClock clock;
  const TreeRays columns = inWorld(rays, 0);
  IntersectionLanes lanes;
  for (std::size_t first = 0; first < tests_.size(); first += IntersectionLanes::kSize)
  {
    const std::size_t some = std::min<std::size_t>(tests_.size() - first, IntersectionLanes::kSize);
    for (unsigned lane = 0; lane < some; ++lane)
    {
      const auto& [ray, number] = tests_[first + lane];
      const TriangleId id = records.numbers().idOf(number);
      const Scene::LocalRay local = scene.localRay(rayOf(rays, ray), id.object);
      lanes.set(lane, local.origin, local.direction, scene.localTriangle(id));
    }
    intersectAll(lanes);
    for (unsigned lane = 0; lane < some; ++lane)
    {
      const auto& [ray, number] = tests_[first + lane];
      columns.keepCloser(
        ray, number, lanes.distance[lane], lanes.weightB[lane], lanes.weightC[lane]);
    }
  }
  clock.ends(Stage::Confirm);
}

void FrontCast::RaysOfBodies::set(
  const std::vector<FrontPairs::Pair>& pairs, std::uint32_t rays, std::uint32_t bodies)
{
  // Counted one place on, so that each count becomes the first place of its body.
  firsts_.assign(bodies + 2, 0);
  for (const FrontPairs::Pair& pair : pairs)
  {
    ++firsts_[pair.reference + 2];
  }
  for (std::uint32_t body = 2; body < bodies + 2; ++body)
  {
    firsts_[body] += firsts_[body - 1];
  }
  rays_.resize(pairs.size());
  for (const FrontPairs::Pair& pair : pairs)
  {
    rays_[firsts_[pair.reference + 1]++] = pair.ray;
  }
  last_.assign(rays, bodies);
}

void FrontCast::LocalRays::need(std::uint32_t room)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    origin[axis].need(room);
    direction[axis].need(room);
  }
  ray.need(room);
  distance.need(room);
  start.need(room);
  hit.need(room);
  weight[0].need(room);
  weight[1].need(room);
}

TreeRays FrontCast::LocalRays::columns(
  std::uint32_t count, std::uint32_t first, std::uint32_t triangles)
{
  return { count, { origin[0].data(), origin[1].data(), origin[2].data() },
    { nullptr, nullptr, nullptr },
    { direction[0].data(), direction[1].data(), direction[2].data() }, start.data(), first,
    triangles, distance.data(), hit.data(), { weight[0].data(), weight[1].data() } };
}

}
