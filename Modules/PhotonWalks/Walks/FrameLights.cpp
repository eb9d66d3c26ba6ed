// SPDX-License-Identifier: BSD-3-Clause
#include "Walks/FrameLights.h"

#include "Repair/SceneChange.h"

#include <algorithm>

namespace irradiance
{

bool FrameLights::areOf(const SceneObjects& objects, const WalkPlan& plan) const
{
  const auto haveMoved = [&] {
    const std::vector<bool> moved = findMoved(objects, objects_);
    return std::find(moved.begin(), moved.end(), true) != moved.end();
  };
  // A wall that a point light touches may move.
  const auto isInAir = [](const WalkSource& source) {
    return !source.lights.boundsInAir().isEmpty();
  };
  return !sources_.empty() && plan == plan_ && areLightsUnchanged(objects, objects_) &&
    !(std::any_of(sources_.begin(), sources_.end(), isInAir) && haveMoved());
}

const std::vector<WalkSource>& FrameLights::sources(const SceneObjects& objects,
  const WalkPlan& plan, ObjectSides& sides, const CancelPoint& cancelPoint)
{
  if (!areOf(objects, plan))
  {
    sources_.clear();
    survey_.reset();
    sources_ = sourcesOf(objects, plan, lightWallsOf(objects, sides, cancelPoint));
    objects_ = objects;
    plan_ = plan;
  }
  return sources_;
}

const LightSurvey& FrameLights::survey(const SceneObjects& objects, const WalkPlan& plan,
  ObjectSides& sides, const CancelPoint& cancelPoint)
{
  const std::vector<WalkSource>& found = sources(objects, plan, sides, cancelPoint);
  if (!survey_)
  {
    survey_.emplace(objects, found);
  }
  return *survey_;
}

}
