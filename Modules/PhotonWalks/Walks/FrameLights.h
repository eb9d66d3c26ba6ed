// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_FrameLights_h
#define irradiance_FrameLights_h

#include "Surfaces/ObjectSides.h"
#include "Walks/LightSurvey.h"
#include "Walks/WalkSource.h"

#include <optional>
#include <vector>

namespace irradiance
{

/// The lights of the frame that was last asked for, as sources of walks, and a survey of them. Both
/// are found when first asked for, and stay as long as the lights do.
class FrameLights
{
public:
  /// As sourcesOf(). `sides`: of the objects.
  const std::vector<WalkSource>& sources(const SceneObjects& objects, const WalkPlan& plan,
    ObjectSides& sides, const CancelPoint& cancelPoint);
  const LightSurvey& survey(const SceneObjects& objects, const WalkPlan& plan, ObjectSides& sides,
    const CancelPoint& cancelPoint);

private:
  bool areOf(const SceneObjects& objects, const WalkPlan& plan) const;

  SceneObjects objects_;
  WalkPlan plan_;
  std::vector<WalkSource> sources_; ///< of these; none before the first frame
  std::optional<LightSurvey> survey_;
};

}

#endif
