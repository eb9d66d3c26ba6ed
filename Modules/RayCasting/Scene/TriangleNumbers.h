// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Ray.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace irradiance
{

/**
 * One number for each triangle of a scene, object after object: the first one of its object plus
 * its own there. Object 0, the static one, comes first. The order of numbers is the order of ids,
 * by which ties of hits are broken.
 */
class TriangleNumbers
{
public:
  static constexpr std::uint32_t kNone = TriangleId::kNone;

  TriangleNumbers() = default;
  /// By object, its triangles. Throws std::length_error if there are more than numbers.
  explicit TriangleNumbers(const std::vector<std::size_t>& sizes)
  {
    firsts_.reserve(sizes.size() + 1);
    for (const std::size_t size : sizes)
    {
      if (size >= kNone - firsts_.back())
      {
        throw std::length_error("the scene has more triangles than there are numbers of 32 bits");
      }
      firsts_.push_back(firsts_.back() + static_cast<std::uint32_t>(size));
    }
    endOfStatic_ = sizes.empty() ? 0 : firsts_[1];
  }

  /// Of all objects.
  std::uint32_t size() const { return firsts_.back(); }
  std::uint32_t objects() const { return static_cast<std::uint32_t>(firsts_.size() - 1); }
  /// The number of the object's first triangle; of the object after the last, size().
  std::uint32_t first(std::uint32_t object) const { return firsts_[object]; }

  /// Of an id that is none, kNone.
  std::uint32_t numberOf(const TriangleId& id) const
  {
    return id.object == kNone ? kNone : firsts_[id.object] + id.triangle;
  }
  TriangleId idOf(std::uint32_t number) const
  {
    const std::uint32_t object = objectOf(number);
    return object == kNone ? TriangleId{} : TriangleId{ object, number - firsts_[object] };
  }
  /// Whose triangle it is; of kNone, kNone.
  std::uint32_t objectOf(std::uint32_t number) const
  {
    return number < endOfStatic_ ? 0 : dynamicObjectOf(number);
  }

  friend bool operator==(const TriangleNumbers& a, const TriangleNumbers& b)
  {
    return a.firsts_ == b.firsts_;
  }
  friend bool operator!=(const TriangleNumbers& a, const TriangleNumbers& b) { return !(a == b); }

private:
  std::uint32_t dynamicObjectOf(std::uint32_t number) const
  {
    if (number == kNone)
    {
      return kNone;
    }
    const auto after = std::upper_bound(firsts_.begin(), firsts_.end(), number);
    return static_cast<std::uint32_t>(after - firsts_.begin()) - 1;
  }

  std::vector<std::uint32_t> firsts_ = { 0 }; ///< by object, and the number of all
  std::uint32_t endOfStatic_ = 0;
};

}
