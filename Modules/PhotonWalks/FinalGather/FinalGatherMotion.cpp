// SPDX-License-Identifier: BSD-3-Clause
#include "FinalGather/FinalGatherMotion.h"

#include "Repair/SceneChange.h"

#include <cmath>

namespace irradiance
{

namespace
{

/// Contains the box, whose coordinates are no floats.
Eigen::AlignedBox3f floatBoxAround(const Box& box)
{
  constexpr float kFar = std::numeric_limits<float>::infinity();
  Eigen::AlignedBox3f around(box.lower.cast<float>(), box.upper.cast<float>());
  for (int axis = 0; axis < 3; ++axis)
  {
    around.min()[axis] = std::nextafter(around.min()[axis], -kFar);
    around.max()[axis] = std::nextafter(around.max()[axis], kFar);
  }
  return around;
}

}

PathsOrigin::PathsOrigin(const FinalGatherScene& scene, const std::vector<SceneCell>& starts)
  : objects(scene.frame.objects)
  , seed(scene.seed)
  , rays(scene.rays)
  , replicates(scene.replicates())
  , startCells(starts)
{
  scene.frame.cells.numbers().forEach([&](const SceneCell& cell) {
    if (scene.isRead(cell))
    {
      readCells.push_back(cell);
    }
  });
  for (const PointDirectLight& asked : scene.lights)
  {
    lights.push_back(asked.lights().lights());
  }
}

std::optional<FinalGatherMotion> FinalGatherMotion::since(
  const PathsOrigin& before, const FinalGatherScene& scene, const PathsOrigin& now)
{
  if (now.seed != before.seed || now.rays != before.rays || now.replicates != before.replicates ||
    now.startCells != before.startCells || now.readCells != before.readCells ||
    now.objects.staticObject.body != before.objects.staticObject.body ||
    hasReplaced(now.objects, before.objects) || !hasAllCells(now.objects, before.objects) ||
    !findRepainted(now.objects, before.objects).empty() ||
    !areLightsUnchanged(now.objects, before.objects) || !(now.lights == before.lights))
  {
    return {};
  }
  return FinalGatherMotion(scene, findMoved(now.objects, before.objects));
}

FinalGatherMotion::FinalGatherMotion(const FinalGatherScene& scene, const std::vector<bool>& moved)
  : moved_(moved)
  , isAny_(hasMotion(moved))
{
  if (!isAny_)
  {
    return;
  }
  const TriangleNumbers& numbers = scene.frame.triangles.numbers();
  firstDynamic_ = numbers.first(1);
  const Scene& space = scene.frame.scene;
  reach_ = space.bounds().extent().norm();
  // Floats have 24 bits. A direction's error counts as far as the segment reaches; what is below
  // all floats is lost.
  const double blur = (space.bounds().magnitude() + reach_) * 0x1p-23 +
    double{ std::numeric_limits<float>::denorm_min() };
  for (std::uint32_t i = 0; i < moved.size(); ++i)
  {
    hasMoved_.resize(numbers.first(i + 2) - firstDynamic_, moved[i] ? 1 : 0);
    if (moved[i] && !scene.frame.objects.dynamicObjects[i].isEmpty())
    {
      // What touches a segment's start may lie behind it, by less than 2^-31 of the coordinates
      // (Contacts).
      const EllipsoidBound bound = space.shadowBound(i, blur);
      bodies_.push_back({ bound, floatBoxAround(bound.worldBox()) });
    }
  }
}

bool FinalGatherMotion::mayChange(const PathSegment& segment) const
{
  if (segment.touchesMover || isMoved(segment.triangle))
  {
    return true;
  }
  const Vector3 to = Eigen::Vector3f(segment.to.data()).cast<double>();
  return mayMeet(segment.from,
    segment.triangle != SceneTriangles::kNone
      ? to
      : Vector3(Eigen::Vector3f(segment.from.data()).cast<double>() + reach_ * to));
}

/// What has not moved and stops a ray goes on to do so.
bool FinalGatherMotion::mayChange(const ShadowRay& ray) const
{
  return isAny_ &&
    (ray.touchesMover || isMoved(ray.triangle) ||
      (ray.triangle == SceneTriangles::kNone &&
        mayMeet(ray.from, Eigen::Vector3f(ray.to.data()).cast<double>())));
}

bool FinalGatherMotion::mayMeet(const std::array<float, 3>& start, const Vector3& end) const
{
  const Eigen::Vector3f from(start.data()), to = end.cast<float>();
  const Eigen::AlignedBox3f box(from.cwiseMin(to), from.cwiseMax(to));
  return std::any_of(bodies_.begin(), bodies_.end(), [&](const Body& body) {
    // Numbers that are none pass.
    const bool isApart = (box.min().array() > body.box.max().array()).any() ||
      (box.max().array() < body.box.min().array()).any();
    return !isApart && !body.bound.rejects(from.cast<double>(), end);
  });
}

}
