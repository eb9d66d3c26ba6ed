// SPDX-License-Identifier: BSD-3-Clause
#include "History/PageScan.h"
#include "Simd/Prefetch.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

namespace irradiance
{
namespace
{

/// One float, and one whole number of 16 bits.
struct GridLanes
{
  using Floats = float;
  using Shorts = int;
  static constexpr std::size_t kFloats = 1, kShorts = 1;

  static Floats all(float value) { return value; }
  static Floats load(const std::int16_t* places) { return *places; }
  static Floats least(Floats a, Floats b) { return a < b ? a : b; }
  static Floats most(Floats a, Floats b) { return a > b ? a : b; }
  static Floats absolute(Floats a) { return std::fabs(a); }
  /// NaN counts as not above.
  static unsigned notAbove(Floats a, Floats b) { return a > b ? 0 : 1; }

  static unsigned stored(const std::uint8_t* tags)
  {
    unsigned bits = 0;
    for (unsigned i = 0; i < PageScan::kGroupSize; ++i)
    {
      bits |= (tags[i] != BounceTag::kFree ? 1u : 0u) << i;
    }
    return bits;
  }
  static unsigned tagged(const std::uint8_t* tags, const TagSet& set)
  {
    unsigned bits = 0;
    for (unsigned i = 0; i < PageScan::kGroupSize; ++i)
    {
      bits |= (set.has(tags[i]) ? 1u : 0u) << i;
    }
    return bits;
  }

  static Shorts allShorts(std::uint32_t twice)
  {
    return static_cast<std::int16_t>(twice & 0xffffu);
  }
  static Shorts loadShorts(const std::int16_t* value) { return *value; }
  /// Divided by 2^15.
  static Shorts multiply(Shorts a, Shorts b) { return (a * b + 0x4000) >> 15; }
  static Shorts add(Shorts a, Shorts b) { return a + b; }
  static Shorts subtract(Shorts a, Shorts b) { return a - b; }
  static Shorts most(Shorts a, Shorts b) { return a > b ? a : b; }
  static Shorts absolute(Shorts a) { return std::abs(a); }
  static unsigned notAbove(Shorts a, Shorts b) { return a > b ? 0 : 1; }
};

}
}

#include "History/GridSegments.inl"
#include "History/PageScan.inl"

namespace irradiance
{

const BounceLoops& bounceLoopsPlain()
{
  return kLoops;
}

}
