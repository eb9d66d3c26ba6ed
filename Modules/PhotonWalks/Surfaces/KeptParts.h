// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Ray.h"
#include "Surfaces/SceneObjects.h"

#include <cstdint>
#include <vector>

namespace irradiance
{

/// Where static parts (see Material::firstCellOfPart) or dynamic objects came or went: what is there
/// still.
struct KeptParts
{
  static constexpr std::uint32_t kNone = TriangleId::kNone;

  /// By number in the frame before, the number of the triangle now; kNone: it is gone. Empty: there
  /// are the same parts and objects.
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint32_t> staticCells; ///< likewise, of the static object's cells
  std::vector<Box> added;                 ///< around each static part that came
  bool isAnyStatic = true;                ///< static part kept
  bool mayTouch = false;                  ///< surfaces coincide now, or did: see Contacts

  bool areAll() const { return triangles.empty(); }
  /// Whether rays may hit other static parts than before.
  bool mayMeetOthers() const { return !added.empty() || mayTouch; }
  bool isGone(std::uint32_t triangle) const
  {
    return triangle < triangles.size() && triangles[triangle] == kNone;
  }
};

/// Static parts stay if they are equal in all, and in the same order; dynamic objects if they have
/// the same place among these. So what stays has the same order as before.
KeptParts keptParts(const SceneObjects& now, const SceneObjects& before);

}
