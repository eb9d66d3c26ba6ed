// SPDX-License-Identifier: BSD-3-Clause
#include "Kernels/CountedBlocks.h"
#include "Kernels/FrontStages.h"
#include "Trees/KdTreeBuilder.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "Kernels/FrontStages.inl"

namespace irradiance
{
namespace
{

/// Four lanes in the vectors of the compiler, which every machine can run.
struct PlainLanes
{
  using Floats = float __attribute__((vector_size(16)));
  using Mask = std::int32_t __attribute__((vector_size(16)));
  static constexpr unsigned kCount = 4;

  static Floats all(float value) { return Floats{ value, value, value, value }; }
  static Floats load(const float* values)
  {
    Floats x;
    std::memcpy(&x, values, sizeof(x));
    return x;
  }
  static void store(float* values, Floats x) { std::memcpy(values, &x, sizeof(x)); }
  static Floats mulAdd(Floats a, Floats b, Floats c) { return a * b + c; }
  static Floats mulSubtract(Floats a, Floats b, Floats c) { return a * b - c; }
  static Floats least(Floats a, Floats b) { return a < b ? a : b; }
  static Floats most(Floats a, Floats b) { return a > b ? a : b; }
  static Floats signOf(Floats x) { return Floats(Mask(x) & Mask(all(-0.0F))); }
  static Floats flip(Floats x, Floats sign) { return Floats(Mask(x) ^ Mask(sign)); }
  static Floats absolute(Floats x) { return flip(x, signOf(x)); }
  static Mask isLess(Floats a, Floats b) { return a < b; }
  static Mask isAtMost(Floats a, Floats b) { return a <= b; }
  static Mask both(Mask a, Mask b) { return a & b; }
  static unsigned bits(Mask mask)
  {
    const Mask flags = mask & Mask{ 1, 2, 4, 8 };
    return static_cast<unsigned>(flags[0] | flags[1] | flags[2] | flags[3]);
  }
  static Mask isOther(const std::uint32_t* references, std::uint32_t skipped)
  {
    Mask isOther;
    for (unsigned lane = 0; lane < kCount; ++lane)
    {
      isOther[lane] = (references[lane] & ~TriangleBlock::kMore) != skipped ? -1 : 0;
    }
    return isOther;
  }
  static unsigned ordered(const Mask (&passed)[4], const std::uint8_t* order)
  {
    const unsigned lanes =
      bits(passed[0]) | bits(passed[1]) << 4 | bits(passed[2]) << 8 | bits(passed[3]) << 12;
    unsigned places = 0;
    for (unsigned place = 0; place < Treelet::kSize; ++place)
    {
      places |= (lanes >> order[place] & 1u) << place;
    }
    return places;
  }
};

}

const FrontStages& frontStagesPlain()
{
  return kStages<PlainLanes, PlainLanes>;
}

}
