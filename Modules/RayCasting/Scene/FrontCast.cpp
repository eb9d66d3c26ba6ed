// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/FrontCast.h"

#include "Scene/FrontTimes.h"

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
  const Scene::Group& dynamic = scene.dynamic_;
  if (dynamic.flattened || !dynamic.bodies.isEmpty())
  {
    // Once a static hit is known, few of many bodies are before it.
    castStatic(scene, records, rays);
    return castDynamicByScene(scene, records, rays);
  }
  for (const std::uint32_t index : dynamic.instanced)
  {
    castBody(scene, index, records, rays);
  }
  castStatic(scene, records, rays);
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

void FrontCast::castBody(
  const Scene& scene, std::uint32_t index, const SurfaceRecords& records, const FrontRays& rays)
{
  FrontClock clock;
  local_.need(TreeRays::roomFor(rays.count));
  const EllipsoidFilter filter = filterOf(scene.placed_[index].bound);
  const std::uint32_t count = pickFront(inWorld(rays, 0), filter, local_.ray.data());
  const std::uint32_t object = index + 1;
  takeToBody(scene, object, rays, count);
  clock.ends(FrontStage::PreTest);
  const TriangleMesh& mesh = scene.meshOf(object);
  search_.run(scene.bodyOf(object),
    local_.columns(count, records.first(object), static_cast<std::uint32_t>(mesh.size())),
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
    const Scene::LocalRay local = scene.localRay(
      { { rays.origin[0][ray], rays.origin[1][ray], rays.origin[2][ray] },
        { rays.direction[0][ray], rays.direction[1][ray], rays.direction[2][ray] }, {} },
      object);
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

void FrontCast::castDynamicByScene(
  const Scene& scene, const SurfaceRecords& records, const FrontRays& rays)
{
  rays_.resize(rays.count);
  hits_.resize(rays.count);
  for (std::uint32_t i = 0; i < rays.count; ++i)
  {
    rays_[i] = { { rays.origin[0][i], rays.origin[1][i], rays.origin[2][i] },
      { rays.direction[0][i], rays.direction[1][i], rays.direction[2][i] },
      records.idOf(rays.start[i]) };
    hits_[i] = { rays.distance[i], records.idOf(rays.hit[i]),
      { rays.weight[0][i], rays.weight[1][i] } };
  }
  scene.castDynamic(rays_.data(), rays.count, hits_.data());
  for (std::uint32_t i = 0; i < rays.count; ++i)
  {
    rays.distance[i] = hits_[i].distance;
    rays.hit[i] = records.numberOf(hits_[i].id);
    rays.weight[0][i] = hits_[i].weights[0];
    rays.weight[1][i] = hits_[i].weights[1];
  }
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
