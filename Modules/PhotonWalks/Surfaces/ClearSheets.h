// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_ClearSheets_h
#define irradiance_ClearSheets_h

#include "Scene/Scene.h"
#include "Surfaces/Contacts.h"
#include "Surfaces/SceneObjects.h"

#include <cstdint>

namespace irradiance
{

/**
 * Clear sheets let rays that look for lamps go on straight. At each, chance says whether such a ray
 * does: with the probability that light does. So it arrives or it is stopped, as without sheets.
 * That is a function of the ray's number and of which sheets stand where. So what has not moved and
 * stops a ray goes on to do so; and a ray that arrives does until something comes in its way.
 *
 * Rays to the same place have numbers in a row: of those almost exactly the right part passes.
 */
struct ClearSheets
{
  const SceneObjects& objects;
  const Scene& scene;
  const Contacts* contacts = nullptr; ///< null: nothing coincides

  /// What stops a ray before its length is `end`, or is hit then. `closest`: its closest hit;
  /// `target`: where it is to arrive.
  Hit stop(const Ray& ray, const Hit& closest, const TriangleId& target, std::uint64_t number,
    double end = 1) const;

private:
  bool passes(const TriangleId& sheet, const Vector3& direction, std::uint64_t number) const;
};

}

#endif
