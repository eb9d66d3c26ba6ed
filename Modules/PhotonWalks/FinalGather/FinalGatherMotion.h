// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_FinalGatherMotion_h
#define irradiance_FinalGatherMotion_h

#include "FinalGather/FinalGatherScene.h"
#include "FinalGather/FollowedPaths.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace irradiance
{

/// What the paths of a final gather depend on besides poses.
struct PathsOrigin
{
  /// Of paths from single points, or from cells that gather.
  explicit PathsOrigin(const FinalGatherScene& scene, const std::vector<SceneCell>& starts = {});

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
  FinalGatherMotion(const FinalGatherScene& scene, const std::vector<bool>& moved);
  /// Nothing if another thing changed, so that no path can be kept. `now`: of the scene.
  static std::optional<FinalGatherMotion> since(
    const PathsOrigin& before, const FinalGatherScene& scene, const PathsOrigin& now);

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
  bool mayChange(const ShadowRay& ray) const;

private:
  /// Whether another hit may be found. Conservative: what moved is widened by all rounding, also of
  /// the segment to floats. `segment`: starts on what did not move, or is behind one that may
  /// change.
  bool mayChange(const PathSegment& segment) const;

  /// Of its number; no triangle has not moved.
  bool isMoved(std::uint32_t triangle) const
  {
    return triangle != SceneTriangles::kNone && triangle >= firstDynamic_ &&
      hasMoved_[triangle - firstDynamic_] != 0;
  }
  /// Whether something that moved may be between two places.
  bool mayMeet(const std::array<float, 3>& from, const Vector3& to) const;

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

#endif
