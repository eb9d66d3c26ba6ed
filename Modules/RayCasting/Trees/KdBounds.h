// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Vector.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace irradiance
{

inline float roundDown(double x)
{
  const float f = static_cast<float>(x);
  return f > x ? std::nextafter(f, -HUGE_VALF) : f;
}

inline float roundUp(double x)
{
  const float f = static_cast<float>(x);
  return f < x ? std::nextafter(f, HUGE_VALF) : f;
}

/// A box of floats, empty at first. Bounds in double are rounded outwards. This loses nothing:
/// planes are floats, and a double is left of a float exactly if it still is when rounded up.
struct KdBounds
{
  static constexpr float kInfinite = std::numeric_limits<float>::infinity();

  float lower[3] = { kInfinite, kInfinite, kInfinite };
  float upper[3] = { -kInfinite, -kInfinite, -kInfinite };

  KdBounds() = default;
  explicit KdBounds(const Box& box)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      lower[axis] = roundDown(box.lower[axis]);
      upper[axis] = roundUp(box.upper[axis]);
    }
  }

  bool isEmpty() const
  {
    return !(lower[0] <= upper[0] && lower[1] <= upper[1] && lower[2] <= upper[2]);
  }
  void intersect(const KdBounds& other)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      lower[axis] = std::max(lower[axis], other.lower[axis]);
      upper[axis] = std::min(upper[axis], other.upper[axis]);
    }
  }
  void add(const KdBounds& other)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      lower[axis] = std::min(lower[axis], other.lower[axis]);
      upper[axis] = std::max(upper[axis], other.upper[axis]);
    }
  }
  /// Half of the surface area. The box must not be empty.
  float halfArea() const
  {
    const float x = upper[0] - lower[0], y = upper[1] - lower[1], z = upper[2] - lower[2];
    return x * y + y * z + z * x;
  }
};

/// The bounds of the part of a primitive that lies in a cell.
struct alignas(16) KdItem : KdBounds
{
  std::uint32_t primitive;

  /// The bounds rounded to the nearest floats.
  static KdItem nearest(std::uint32_t primitive, const Box& bounds)
  {
    KdItem item;
    Eigen::Map<Eigen::Vector3f>{ item.lower } = bounds.lower.cast<float>();
    Eigen::Map<Eigen::Vector3f>{ item.upper } = bounds.upper.cast<float>();
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
