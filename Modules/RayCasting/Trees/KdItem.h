// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_KdItem_h
#define irradiance_KdItem_h

#include "Trees/KdBounds.h"

#include <cstdint>

namespace irradiance
{

/// The bounds of the part of a primitive that lies in a cell.
struct alignas(16) KdItem : KdBounds
{
  std::uint32_t primitive;

  static KdItem of(std::uint32_t primitive, const Box& bounds)
  {
    KdItem item;
    static_cast<KdBounds&>(item) = KdBounds(bounds);
    item.primitive = primitive;
    return item;
  }
  /// The bounds rounded to the nearest floats.
  static KdItem nearest(std::uint32_t primitive, const Box& bounds)
  {
    KdItem item;
    for (int axis = 0; axis < 3; ++axis)
    {
      item.lower[axis] = static_cast<float>(bounds.lower[axis]);
      item.upper[axis] = static_cast<float>(bounds.upper[axis]);
    }
    item.primitive = primitive;
    return item;
  }
};

/// The items of a node, contiguous in memory.
struct KdItems
{
  const KdItem* first;
  const KdItem* last;

  const KdItem* begin() const { return first; }
  const KdItem* end() const { return last; }
  std::uint32_t size() const { return static_cast<std::uint32_t>(last - first); }
};

/// The bounds of all items together.
inline KdBounds hullOf(const KdItems& items)
{
  KdBounds hull;
  for (const KdItem& item : items)
  {
    hull.add(item);
  }
  return hull;
}

}

#endif
