// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PathLights_h
#define irradiance_PathLights_h

#include "DirectLight/PointDirectLight.h"
#include "Walks/WalkSets.h"

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

namespace irradiance
{

/// Of a point that a path hits, see lightsOf(): the path is one of many.
constexpr std::uint32_t kSamplesOfHit = 4;

/// All lights but those of foundLamps(), whether walks start there or cells gather what they send,
/// for points that ask them by themselves; or only those that are `gathered`. The arguments must
/// outlive what is returned. `samples`: of each point, for each group of lights.
std::deque<PointDirectLight> lightsOf(const WalkSets& walks, const Frame& frame, std::uint64_t seed,
  std::uint32_t samples, std::size_t mostWeights = LampChoice::kMost, bool gathered = false);

/// A point light that specular cells reflect. A path meets no point, and the sums of walks do not
/// tell what came by way of which reflection: so no final gather knows that light.
struct UnseenLight
{
  SceneCell light, specular;
  double flux;        ///< of the light, W, all bands together
  double reflectance; ///< specular, of the most reflecting band

  /// What is wrong, and what may be done. `gather`: what does not know the light. The cells are
  /// named as they are here.
  std::string message(
    const std::string& gather, const std::string& lightName, const std::string& specularName) const;
};

/// The first ones; nothing if there are none.
std::optional<UnseenLight> unseenLight(const SceneObjects& objects);

/// Throws InputError for an unseenLight().
void checkLights(const SceneObjects& objects, const std::string& gather);

}

#endif
