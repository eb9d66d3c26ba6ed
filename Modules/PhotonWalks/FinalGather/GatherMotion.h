// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_GatherMotion_h
#define irradiance_GatherMotion_h

#include "FinalGather/FollowedPaths.h"
#include "FinalGather/GatherScene.h"

#include <algorithm>
#include <vector>

namespace irradiance
{

/// What moved since paths were followed, and which of their segments it may change.
class GatherMotion
{
public:
  /// `moved`: of the dynamic objects of the frame, those with another pose, or other points, than when the paths
  /// were followed.
  GatherMotion(const GatherScene& scene, const std::vector<bool>& moved);

  bool isNone() const { return !isAny_; }
  bool hasMoved(std::uint32_t object) const { return object > 0 && moved_[object - 1]; }
  /// Of a path that starts on what did not move.
  bool mayChange(const FollowedPaths::Path& path) const
  {
    return std::any_of(
      path.begin, path.end, [&](const GatherSegment& segment) { return mayChange(segment); });
  }

private:
  /// Whether another hit may be found, or light arrive that did not, or the other way round. Conservative: what moved is widened by all rounding, also of the segment
  /// to floats. `segment`: starts on what did not move, or is behind one that may change.
  bool mayChange(const GatherSegment& segment) const;

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
