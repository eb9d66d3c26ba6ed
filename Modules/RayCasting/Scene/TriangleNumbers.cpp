// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/TriangleNumbers.h"

#include <algorithm>
#include <stdexcept>

namespace irradiance
{

TriangleNumbers::TriangleNumbers(const std::vector<std::size_t>& sizes)
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

std::uint32_t TriangleNumbers::dynamicObjectOf(std::uint32_t number) const
{
  if (number == kNone)
  {
    return kNone;
  }
  const auto after = std::upper_bound(firsts_.begin(), firsts_.end(), number);
  return static_cast<std::uint32_t>(after - firsts_.begin()) - 1;
}

}
