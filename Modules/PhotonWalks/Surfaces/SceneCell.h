// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SceneCell_h
#define irradiance_SceneCell_h

#include <cstddef>
#include <cstdint>

namespace irradiance
{

/// A cell of the scene: which one of which object.
struct SceneCell
{
  std::uint32_t object = 0;
  std::size_t cell = 0;

  friend bool operator==(const SceneCell& a, const SceneCell& b)
  {
    return a.object == b.object && a.cell == b.cell;
  }
};

/// A side of a cell.
struct CellSide : SceneCell
{
  int side = 0; ///< 0 the front, or both if sides are not kept apart; 1 the back
};

}

#endif
