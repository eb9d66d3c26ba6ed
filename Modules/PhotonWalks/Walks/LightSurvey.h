// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "DirectLight/LampPieces.h"
#include "Surfaces/ObjectSides.h"
#include "Walks/WalkSource.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <optional>
#include <vector>

namespace irradiance
{

/**
 * A source for the sky and for all other lights, and of these for each class of power, see
 * powerClassesOf(); one without lights if nothing shines.
 *
 * A single one has all walks of the plan. Several share them by flux, of classes half of them
 * alike, and number them one source after the other. Their shares are rounded: to walks that all
 * replicates have as many of, which double from round to round. So a walk has more power in one
 * source than in another, and a quantum is as many watts in all; rounded to whole quanta, the power
 * of a source is off by less than half a quantum for each walk. Throws as LightTable does.
 */
std::vector<WalkSource> sourcesOf(
  const SceneObjects& objects, const WalkPlan& plan, const LightWalls& walls = {});

/// How the light of a lamp is best known.
enum class Known
{
  Dim,     ///< walks start at it, and rays find it
  Shot,    ///< walks start at it
  Gathered ///< cells look for it
};

/**
 * Looks at the lights of a scene before any walk is shot: how each is best known, and how unevenly
 * they light what rests.
 *
 * It depends on the lights and on the static object alone, so that no motion of others changes it.
 */
class LightSurvey
{
public:
  /// Of a source that starts at lights.
  struct Group
  {
    std::vector<Known> known; ///< by light
    std::shared_ptr<const LampPieces>
      lamps;                       ///< of those that are neither dim nor near; null: none are
    bool areHardToFind = false;    ///< these: they are shot, as to look for them costs more
    double walksPerSample = 0;     ///< of these else, see DirectPlan
    double variance = 0, cost = 1; ///< of these, see DirectPilot

    bool isGathered() const { return lamps && !areHardToFind; }
    /// Those of the source that are known in this way.
    LightTable lightsOf(const WalkSource& source, Known part) const;
  };

  /// Of a walk that starts at a cell, beside one from a light. `reflected`: by static cells, on
  /// average: where this is little, many weak walks are of no use.
  static double powerOfStart(double reflected) { return std::clamp(reflected, 0.0625, 1.0); }

  LightSurvey(const SceneObjects& objects, const std::vector<WalkSource>& sources);

  const std::vector<Group>& groups() const { return groups_; }
  /// The mean square of what static surfaces send for their area, beside the square of the mean: 1
  /// if all send alike, and as much more as there is light on small spots. What is reflected once
  /// stands for all that is.
  double unevenness() const { return unevenness_; }
  /// Of the lights that are hard to find, see DirectPilot; 0 if there are none.
  double hiddenVariance() const
  {
    double most = 0;
    for (const Group& group : groups_)
    {
      most = group.areHardToFind ? std::max(most, group.variance) : most;
    }
    return most;
  }
  /// Likewise of those that are gathered; the part of static lights, as a thing that moves has no
  /// light of its own lamps.
  double gatheredVariance() const
  {
    double sum = 0, flux = 0;
    for (const Group& group : groups_)
    {
      if (group.isGathered())
      {
        const std::vector<Light>& lights = group.lamps->lights().lights();
        sum += group.variance *
          std::accumulate(lights.begin(), lights.end(), 0.0, [](double watts, const Light& light) {
            return watts + (light.cell.object == 0 ? light.totalFlux() : 0);
          });
        flux += group.lamps->lights().flux();
      }
    }
    return flux > 0 ? sum / flux : 0;
  }
  /// Of all lights that are neither dim nor near, see DirectPilot; 1 if all others are, 0 without
  /// lights.
  double gatheringCost() const
  {
    double sum = 0, flux = 0;
    bool hasLights = false;
    for (const Group& group : groups_)
    {
      hasLights = hasLights || !group.known.empty();
      if (group.lamps)
      {
        sum += group.cost * group.lamps->lights().flux();
        flux += group.lamps->lights().flux();
      }
    }
    return flux > 0 ? sum / flux : hasLights ? 1 : 0;
  }

private:
  std::vector<Group> groups_; ///< by source
  double unevenness_ = 1;
};

/// The lights of a frame, as sources of walks, and a survey of them. They stay as long as the lights
/// do.
class FrameLights
{
public:
  /// `sides`: of the objects.
  void update(const SceneObjects& objects, const WalkPlan& plan, ObjectSides& sides,
    const CancelPoint& cancelPoint);
  /// As sourcesOf().
  const std::vector<WalkSource>& sources() const { return sources_; }
  /// It is found when first asked for.
  const LightSurvey& survey() { return survey_ ? *survey_ : survey_.emplace(objects_, sources_); }

private:
  SceneObjects objects_;
  WalkPlan plan_;
  std::vector<WalkSource> sources_; ///< of these; none before the first frame
  std::optional<LightSurvey> survey_;
};

/**
 * Where cells gather direct light: for each source one whose walks start at static cells, and one
 * for each of the other cellParts(). Lights that are better known otherwise have sources of their
 * own, whose walks start at the lights, as the survey of the same sources says. Walks are shared as
 * among groups. About as many walks start at cells as the plan has, if the light falls on static
 * cells that reflect as all of them on average.
 */
std::vector<WalkSource> directSourcesOf(const SceneObjects& objects,
  const std::vector<WalkSource>& sources, const LightSurvey& survey,
  const FewestSamples& fewestSamples);

/// Makes the lights of sources known to what asks them: it takes a while, and once for all parts of
/// the cells is enough.
void addLamps(std::vector<WalkSource>& sources);

}
