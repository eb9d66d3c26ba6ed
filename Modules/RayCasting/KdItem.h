#ifndef irradiance_KdItem_h
#define irradiance_KdItem_h

#include "Vector.h"

#include <cstdint>

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

/// A primitive as far as it lies in a cell. The bounds are rounded outwards, which loses nothing:
/// planes are floats, and a double is left of a float exactly if it is so when rounded up.
struct alignas(16) KdItem
{
  float lower[3], upper[3];
  std::uint32_t primitive;

  static KdItem of(std::uint32_t primitive, const Box& bounds)
  {
    KdItem item;
    for (int axis = 0; axis < 3; ++axis)
    {
      item.lower[axis] = roundDown(bounds.lower[axis]);
      item.upper[axis] = roundUp(bounds.upper[axis]);
    }
    item.primitive = primitive;
    return item;
  }

  bool isEmpty() const
  {
    return !(lower[0] <= upper[0] && lower[1] <= upper[1] && lower[2] <= upper[2]);
  }
  void intersect(const KdItem& other)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      lower[axis] = std::max(lower[axis], other.lower[axis]);
      upper[axis] = std::min(upper[axis], other.upper[axis]);
    }
  }
};

/// The items of a node, side by side.
struct KdItems
{
  const KdItem* first;
  const KdItem* last;

  const KdItem* begin() const { return first; }
  const KdItem* end() const { return last; }
  std::uint32_t size() const { return static_cast<std::uint32_t>(last - first); }
};

}

#endif
