// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/DirectionSampling.h"
#include "Shooting/FrontLoops.h"
#include "Simd/Prefetch.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "Shooting/FrontLoops.inl"

namespace irradiance
{
namespace
{

struct PlainLanes
{
  static unsigned maskOf(const std::uint32_t* flags)
  {
    unsigned mask = 0;
    for (unsigned lane = 0; lane < kGroup; ++lane)
    {
      mask |= flags[lane] << lane;
    }
    return mask;
  }

  /// Without AVX, vectors of four numbers are slower.
  static void transpose(const double* const (&rows)[4], double* const (&columns)[4])
  {
    for (unsigned column = 0; column < 4; ++column)
    {
      for (unsigned row = 0; row < 4; ++row)
      {
        columns[column][row] = rows[row][column];
      }
    }
  }

  /// Writes each value, and goes on behind those that stay: which do is unpredictable.
  class Packing
  {
  public:
    explicit Packing(unsigned mask)
      : mask_(mask)
    {
    }

    template <class Value>
    void operator()(const Value* from, Value* to) const
    {
      unsigned kept = 0;
      for (unsigned lane = 0; lane < kPacked; ++lane)
      {
        to[kept] = from[lane];
        kept += mask_ >> lane & 1u;
      }
    }

  private:
    unsigned mask_;
  };
};

}

const FrontLoops& frontLoopsPlain()
{
  return kLoops<PlainLanes>;
}

}
