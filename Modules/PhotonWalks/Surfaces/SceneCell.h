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

/// A side of a cell, or both together.
struct CellSide : SceneCell
{
  static constexpr int kBoth = 2;
  int side = kBoth; ///< 0 the front, 1 the back, or kBoth
};

/// Calls visit(CellSide) for what is told of a cell: each of its sides, or both together.
template <class Visit>
void forEachSide(const SceneCell& cell, bool areApart, const Visit& visit)
{
  if (!areApart)
  {
    visit(CellSide{ cell });
    return;
  }
  visit(CellSide{ cell, 0 });
  visit(CellSide{ cell, 1 });
}

}

#endif
