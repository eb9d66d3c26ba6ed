// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/CosineDirectionInFloat.h"
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

  static void transpose(const double* const* rows, double (*columns)[RecordLanes::kSize])
  {
    for (unsigned lane = 0; lane < RecordLanes::kSize; ++lane)
    {
      for (unsigned column = 0; column < RecordLanes::Columns; ++column)
      {
        columns[column][lane] = rows[lane][column];
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
      for (unsigned lane = 0; lane < kGroup; ++lane)
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

#define IRRADIANCE_LEVEL(name) name##Plain
#define IRRADIANCE_LANES PlainLanes
#include "Shooting/FrontLoopsOf.inl"

}
