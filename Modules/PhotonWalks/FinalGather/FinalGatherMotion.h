// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "FinalGather/FinalGatherScene.h"
#include "FinalGather/FollowedPaths.h"
#include "Repair/SceneChange.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace irradiance
{

/// What the paths of a final gather depend on besides poses.
struct PathsOrigin
{
  /// Of paths from single points, or from cells that gather.
  explicit PathsOrigin(const FinalGatherScene& scene, const std::vector<SceneCell>& starts = {})
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

  SceneObjects objects;
  std::uint64_t seed;
  std::uint32_t rays, replicates;
  std::vector<SceneCell> startCells, readCells;
  std::vector<std::vector<Light>> lights; ///< in the groups that are asked
};

/// What moved since paths were followed, and which of their segments it may change.
class FinalGatherMotion
{
public:
  /// `moved`: of the dynamic objects of the frame, those with another pose, or other points, than
  /// when the paths were followed.
  FinalGatherMotion(const FinalGatherScene& scene, const std::vector<bool>& moved)
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
  /// Nothing if another thing changed, so that no path can be kept. `now`: of the scene.
  static std::optional<FinalGatherMotion> since(
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

  bool isNone() const { return !isAny_; }
  bool hasMoved(std::uint32_t object) const { return object > 0 && moved_[object - 1]; }
  /// Of a path that starts on what did not move.
  bool mayChange(const FollowedPaths::Path& path) const
  {
    const auto may = [&](const auto& ray) { return mayChange(ray); };
    return isAny_ &&
      (std::any_of(path.begin, path.end, may) || std::any_of(path.shadows, path.endOfShadows, may));
  }

  /// Whether its light may arrive now if it did not, or the other way round; conservative likewise.
  /// What has not moved and stops a ray goes on to do so.
  bool mayChange(const ShadowRay& ray) const
  {
    return isAny_ &&
      (ray.touchesMover || isMoved(ray.triangle) ||
        (ray.triangle == SceneTriangles::kNone &&
          mayMeet(ray.from, Eigen::Vector3f(ray.to.data()).cast<double>())));
  }

private:
  /// Contains the box, whose coordinates are no floats.
  static Eigen::AlignedBox3f floatBoxAround(const Box& box)
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
  /// Whether another hit may be found. Conservative: what moved is widened by all rounding, also of
  /// the segment to floats. `segment`: starts on what did not move, or is behind one that may
  /// change.
  bool mayChange(const PathSegment& segment) const
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

  /// Of its number; no triangle has not moved.
  bool isMoved(std::uint32_t triangle) const
  {
    return triangle != SceneTriangles::kNone && triangle >= firstDynamic_ &&
      hasMoved_[triangle - firstDynamic_] != 0;
  }
  /// Whether something that moved may be between two places.
  bool mayMeet(const std::array<float, 3>& start, const Vector3& end) const
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

  struct Body
  {
    EllipsoidBound bound;
    Eigen::AlignedBox3f box; ///< contains that of the bound
  };

  std::vector<bool> moved_;
  std::vector<char> hasMoved_; ///< by triangle, of dynamic objects
  std::uint32_t firstDynamic_ = 0;
  std::vector<Body> bodies_;
  double reach_ = 0; ///< nothing that is hit is farther, m
  bool isAny_;
};

}
