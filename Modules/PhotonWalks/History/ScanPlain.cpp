// SPDX-License-Identifier: BSD-3-Clause
#include "History/PointScan.h"
#include "History/WalkBlock.h"
#include "Simd/Prefetch.h"

#include <algorithm>

#include "History/WideScan.inl"

namespace irradiance
{
namespace
{

struct PlainLanes
{
  using Floats = float;
  static constexpr std::size_t kCount = 1;

  static Floats all(float value) { return value; }
  static Floats load(const float* values) { return *values; }
  static Floats mulAdd(Floats a, Floats b, Floats c) { return a * b + c; }
  static Floats subtractMul(Floats a, Floats b, Floats c) { return a - b * c; }
  static Floats least(Floats a, Floats b) { return a < b ? a : b; }
  static Floats most(Floats a, Floats b) { return a > b ? a : b; }
  static bool isLess(Floats a, Floats b) { return a < b; }
  static Floats choose(bool first, Floats a, Floats b) { return first ? a : b; }
  /// NaN counts as not above.
  static unsigned notAbove(Floats a, Floats b) { return a > b ? 0 : 1; }
  static unsigned tagged(const std::uint16_t* tags, std::uint32_t set)
  {
    return set >> (std::uint32_t{ *tags } >> WalkBlock::kTagShift) & 1u;
  }
};

}

void runScanPlain(const PointScan& scan)
{
  runScan<PlainLanes>(scan);
}

}
