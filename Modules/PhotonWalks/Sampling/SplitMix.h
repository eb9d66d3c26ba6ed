// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SplitMix_h
#define irradiance_SplitMix_h

#include <cstdint>

namespace irradiance
{

/// A hash of 64 bits: a step of SplitMix64 (Steele, Lea and Flood 2014).
inline std::uint64_t splitMix(std::uint64_t x)
{
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
  x = (x ^ x >> 27) * 0x94d049bb133111ebu;
  return x ^ x >> 31;
}

}

#endif
