// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_ClearSheets_h
#define irradiance_ClearSheets_h

#include "Scene/Scene.h"
#include "Surfaces/Contacts.h"
#include "Surfaces/SceneObjects.h"

#include <functional>
#include <vector>

namespace irradiance
{

/// What is left of the light of a ray that looks for lamps, as clear sheets let it go straight on.
struct ClearSheets
{
  const SceneObjects& objects;
  const Scene& scene;
  const Contacts* contacts = nullptr; ///< null: nothing coincides

  /// Where a ray ends, and what clear sheets before leave.
  struct Way
  {
    Hit hit;
    double passed = 1;        ///< > 0, a multiple of 2^-24
    bool meetsMovers = false; ///< some of these sheets are dynamic
  };
  /// What stops each ray before its length is `end`, or is hit then. `closest`: their closest hits;
  /// `targetOf`: by place, where it is to arrive.
  std::vector<Way> follow(const Ray* rays, const Hit* closest, std::size_t count,
    const std::function<TriangleId(std::size_t)>& targetOf, double end = 1) const;

private:
  /// The part that goes straight through; 0 if that is no clear sheet.
  double passing(const TriangleId& sheet, const Vector3& direction) const;
};

}

#endif
