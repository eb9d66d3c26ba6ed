// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SampleLanes_h
#define irradiance_SampleLanes_h

#include "Sampling/SobolSequence.h"

namespace irradiance
{

/// Samples of many walks, side by side.
struct SampleLanes
{
  static constexpr unsigned kSize = 32;

  alignas(64) std::uint32_t index[kSize] = {}, shuffle[kSize] = {};
  alignas(64) std::uint32_t scrambleX[kSize] = {}, scrambleY[kSize] = {};
  alignas(64) double x[kSize] = {}, y[kSize] = {}; ///< the samples, in (0, 1)

  __attribute__((always_inline)) void set(unsigned lane, const SobolSequence& samples,
    std::uint32_t walk, std::uint32_t bounce, SampleUse use)
  {
    const SampleKeys keys = samples.keysOf(walk, bounce, use);
    index[lane] = samples.indexOf(walk);
    shuffle[lane] = keys.shuffle;
    scrambleX[lane] = keys.scrambles[0];
    scrambleY[lane] = keys.scrambles[1];
  }

  /// Is compiled once for each instruction set.
  __attribute__((always_inline)) void draw()
  {
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      const SobolPoint point(index[lane], shuffle[lane], scrambleX[lane], scrambleY[lane]);
      x[lane] = SobolPoint::toUnit(point.x);
      y[lane] = SobolPoint::toUnit(point.y);
    }
  }
  /// Only the first coordinates.
  __attribute__((always_inline)) void drawFirst()
  {
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      x[lane] = SobolPoint::toUnit(SobolPoint(index[lane], shuffle[lane], scrambleX[lane], 0).x);
    }
  }
};

}

#endif
