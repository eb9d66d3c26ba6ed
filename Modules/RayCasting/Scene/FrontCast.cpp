// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/FrontCast.h"

#include <algorithm>

namespace irradiance
{

namespace
{

Ray rayOf(const TreeRays& rays, std::uint32_t ray)
{
  return { originOf(rays, ray), directionOf(rays, ray), {} };
}

CornerRows rowsOf(const TriangleMesh& mesh)
{
  static_assert(sizeof(Triangle) == 9 * sizeof(double));
  return { reinterpret_cast<const double*>(mesh.triangles().data()), 9 };
}

}

FrontTriangles::FrontTriangles(const SurfaceRecords& records)
  : numbers(records.numbers())
  , corners{ records.rows()->a, sizeof(SurfaceRecord) / sizeof(double) }
{
}

FrontTriangles::FrontTriangles(const TriangleNumbers& all, const TriangleMesh& still)
  : numbers(all)
  , corners(rowsOf(still))
{
}

void FrontCast::cast(const Scene& scene, const Ray* rays, std::size_t count, Hit* hits)
{
  constexpr std::size_t kTogether = 1024;
  for (std::size_t first = 0; first < count; first += kTogether)
  {
    castSome(scene, rays + first, static_cast<std::uint32_t>(std::min(count - first, kTogether)),
      hits + first);
  }
}

void FrontCast::castSome(const Scene& scene, const Ray* rays, std::uint32_t count, Hit* hits)
{
  const TriangleNumbers& numbers = scene.numbers_;
  own_.need(TreeRays::roomFor(count));
  for (std::uint32_t i = 0; i < count; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      own_.origin[axis][i] = rays[i].origin[axis];
      own_.direction[axis][i] = rays[i].direction[axis];
    }
    own_.start[i] = numbers.numberOf(rays[i].start);
    own_.distance[i] = kInfinity;
    own_.hit[i] = TreeRays::kNone;
    own_.weight[0][i] = own_.weight[1][i] = 0;
  }
  const TreeRays own = own_.columns(count, 0, 0);
  cast(scene, { numbers, scene.static_->mesh() }, own);
  for (std::uint32_t i = 0; i < count; ++i)
  {
    hits[i] = { own.distance[i], numbers.idOf(own.hit[i]), { own.weight[0][i], own.weight[1][i] } };
  }
}

void FrontCast::cast(const Scene& scene, const FrontTriangles& triangles, const TreeRays& rays)
{
  if (scene.mode_ == TraversalMode::OneTree && !scene.placed_.empty())
  {
    return castMixed(scene, scene.oneTree_, triangles, rays);
  }
  // Once a static hit is known, few of many bodies are before it.
  const bool isStaticFirst =
    scene.mode_ == TraversalMode::Parallel && (scene.dynamic_.flattened || scene.dynamic_.isMany());
  if (isStaticFirst)
  {
    castStatic(scene, triangles, rays);
  }
  castDynamic(scene, triangles, rays);
  if (!isStaticFirst)
  {
    castStatic(scene, triangles, rays);
  }
}

void FrontCast::castGroup(const Scene& scene, const Scene::Group& group,
  const FrontTriangles& triangles, const TreeRays& rays)
{
  if (group.flattened)
  {
    castMixed(scene, *group.flattened, triangles, rays);
  }
  if (group.isMany())
  {
    return castBodies(scene, group, triangles, rays);
  }
  for (const std::uint32_t index : group.instanced)
  {
    castBody(scene, index, triangles, rays);
  }
}

void FrontCast::castStatic(
  const Scene& scene, const FrontTriangles& triangles, const TreeRays& rays)
{
  const auto count = static_cast<std::uint32_t>(scene.static_->mesh().size());
  if (count > 0)
  {
    TreeRays world = rays;
    world.triangles = count;
    scene.static_->forEachTree([&](const TriangleTree& tree) {
      search_.run(tree, scene.static_->mesh(), world, triangles.corners);
    });
  }
}

void FrontCast::castMixed(const Scene& scene, const Scene::MixedTree& mixed,
  const FrontTriangles& triangles, const TreeRays& rays)
{
  start_.need(TreeRays::roomFor(rays.count));
  for (std::uint32_t ray = 0; ray < rays.count; ++ray)
  {
    start_[ray] = mixed.referenceTo(triangles.numbers.idOf(rays.start[ray]));
  }
  TreeRays world = rays;
  world.triangles = static_cast<std::uint32_t>(mixed.ids.size());
  world.start = start_.data();
  tests_.clear();
  for (const auto& [ray, reference] : pairs_.find(mixed.tree, world))
  {
    const TriangleId& id = mixed.ids[reference];
    addTest(scene, ray, triangles.numbers.numberOf(id), id);
  }
  runTests(scene, triangles, rays);
}

void FrontCast::castBody(
  const Scene& scene, std::uint32_t index, const FrontTriangles& triangles, const TreeRays& rays)
{
  local_.need(TreeRays::roomFor(rays.count));
  const std::uint32_t count =
    frontStages().pick(rays, scene.placed_[index].filter, local_.ray.data());
  castPicked(scene, index, triangles, rays, count);
}

void FrontCast::castBodies(const Scene& scene, const Scene::Group& group,
  const FrontTriangles& triangles, const TreeRays& rays)
{
  const auto bodies = static_cast<std::uint32_t>(group.instanced.size());
  const std::vector<FrontPairs::Pair>& pairs =
    group.balls.isEmpty() ? pairs_.find(group.bodies, rays) : pairs_.find(group.balls, rays);
  raysOfBodies_.set(pairs, rays.count, bodies);
  local_.need(TreeRays::roomFor(rays.count));
  for (std::uint32_t body = 0; body < bodies; ++body)
  {
    const std::uint32_t index = group.instanced[body];
    std::uint32_t count = 0;
    raysOfBodies_.forEach(body, [&](std::uint32_t ray) {
      local_.ray[count] = ray;
      count += scene.mayTouch(scene.placed_[index], rayOf(rays, ray), rays.distance[ray]) ? 1 : 0;
    });
    castPicked(scene, index, triangles, rays, count);
  }
}

/// Casts the rays in `local_.ray`, so many, to a body.
void FrontCast::castPicked(const Scene& scene, std::uint32_t index, const FrontTriangles& triangles,
  const TreeRays& rays, std::uint32_t count)
{
  if (count == 0)
  {
    return;
  }
  const std::uint32_t object = index + 1;
  for (std::uint32_t i = 0; i < count; ++i)
  {
    const std::uint32_t ray = local_.ray[i];
    // By the same operations as everywhere, so that hits have the same bits.
    const Ray local = scene.localRay(rayOf(rays, ray), object);
    for (int axis = 0; axis < 3; ++axis)
    {
      local_.origin[axis][i] = local.origin[axis];
      local_.direction[axis][i] = local.direction[axis];
    }
    local_.start[i] = rays.start[ray];
    local_.distance[i] = rays.distance[ray];
    local_.hit[i] = rays.hit[ray];
  }
  const TriangleMesh& mesh = scene.meshOf(object);
  search_.run(scene.bodyOf(object).tree(), mesh,
    local_.columns(count, triangles.numbers.first(object), static_cast<std::uint32_t>(mesh.size())),
    rowsOf(mesh));
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
  const Scene& scene, const FrontTriangles& triangles, const TreeRays& rays)
{
  const auto statics = static_cast<std::uint32_t>(scene.static_->mesh().size());
  const std::uint32_t room = TreeRays::roomFor(rays.count);
  candidate_.need(room);
  std::fill_n(candidate_.data() + rays.count, room - rays.count, TreeRays::kNone);
  std::fill_n(rays.distance, rays.count, kInfinity);
  tests_.clear();
  for (std::uint32_t ray = 0; ray < rays.count; ++ray)
  {
    const std::uint32_t hit = rays.hit[ray];
    const bool isStatic = hit < statics;
    candidate_[ray] = isStatic ? hit : TreeRays::kNone;
    if (!isStatic && hit != TreeRays::kNone)
    {
      addTest(scene, ray, hit, triangles.numbers.idOf(hit));
    }
  }
  if (statics > 0)
  {
    frontStages().confirm(rays, candidate_.data(), triangles.corners);
  }
  runTests(scene, triangles, rays);
}

/// Prefetches the triangle.
void FrontCast::addTest(
  const Scene& scene, std::uint32_t ray, std::uint32_t number, const TriangleId& id)
{
  scene.bodyOf(id.object).mesh().prefetch(id.triangle);
  tests_.push_back({ ray, number });
}

/// Tests what was added, and keeps the closer hits.
void FrontCast::runTests(const Scene& scene, const FrontTriangles& triangles, const TreeRays& rays)
{
  confirmEach(rays, tests_.size(), [&](std::size_t i, IntersectionLanes& lanes, unsigned lane) {
    const auto& [ray, number] = tests_[i];
    const TriangleId id = triangles.numbers.idOf(number);
    const Ray local = scene.localRay(rayOf(rays, ray), id.object);
    lanes.set(lane, local.origin, local.direction, scene.localTriangle(id));
    return tests_[i];
  });
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
    { direction[0].data(), direction[1].data(), direction[2].data() }, start.data(),
    distance.data(), hit.data(), { weight[0].data(), weight[1].data() }, first, triangles };
}

}
