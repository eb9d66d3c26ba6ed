// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_CellPart_h
#define irradiance_CellPart_h

#include "Surfaces/SceneObjects.h"

#include <cstdint>
#include <vector>

namespace irradiance
{

/// Objects [first, end) whose cells gather together: the static one alone, or some of the dynamic
/// ones. When one of them moves, all of them gather anew.
struct CellPart
{
  std::uint32_t first = 0, end = 1;

  bool isStatic() const { return first == 0; }
  friend bool operator==(const CellPart& a, const CellPart& b)
  {
    return a.first == b.first && a.end == b.end;
  }
};

/// The static part, and those that have all dynamic objects. There are more of these the fewer
/// cells there are, as each has sums for all cells.
std::vector<CellPart> cellParts(const SceneObjects& objects);

}

#endif
