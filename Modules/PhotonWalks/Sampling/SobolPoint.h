// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Sampling/ElementaryFunctions.h"

#include <array>
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

/// What randomizes the points of one bounce and use, see SobolSequence.
struct SampleKeys
{
  std::uint32_t shuffle;      ///< of the index
  std::uint32_t scrambles[2]; ///< of the coordinates

  SampleKeys() = default;
  /// From a hash.
  explicit SampleKeys(std::uint64_t hash)
    : shuffle(static_cast<std::uint32_t>(hash))
  {
    const std::uint64_t both = splitMix(hash);
    scrambles[0] = static_cast<std::uint32_t>(both);
    scrambles[1] = static_cast<std::uint32_t>(both >> 32);
  }
};

/// A randomized point of the first two Sobol' dimensions, in units of 2^-32. Without branches, so
/// that a loop over many becomes SIMD.
struct SobolPoint
{
  std::uint32_t x, y;

  __attribute__((always_inline)) SobolPoint(
    std::uint32_t index, std::uint32_t shuffle, std::uint32_t scrambleX, std::uint32_t scrambleY)
  {
    const std::uint32_t shuffled = reversed(permuted(reversed(index), shuffle));
    // The first dimension reverses the bits of the index; scrambling reverses them once more.
    x = reversed(permuted(shuffled, scrambleX));
    y = reversed(permuted(pascal(shuffled), scrambleY));
  }

  static std::array<double, 2> inUnitSquare(std::uint32_t index, const SampleKeys& keys)
  {
    const SobolPoint point(index, keys.shuffle, keys.scrambles[0], keys.scrambles[1]);
    return { toUnit(point.x), toUnit(point.y) };
  }

  /// A coordinate as a number in (0, 1): a multiple of 2^-32 plus 2^-33.
  __attribute__((always_inline)) static double toUnit(std::uint32_t coordinate)
  {
    // By way of a signed number, which SIMD converts faster.
    const auto centered = static_cast<std::int32_t>(coordinate ^ 0x80000000u);
    return (centered + 2147483648.5) * 0x1p-32;
  }

  /// Bits in reverse order: van der Corput's radical inverse as a fixed-point number.
  __attribute__((always_inline)) static std::uint32_t reversed(std::uint32_t x)
  {
    x = x << 16 | x >> 16;
    x = (x & 0x00ff00ffu) << 8 | (x & 0xff00ff00u) >> 8;
    x = (x & 0x0f0f0f0fu) << 4 | (x & 0xf0f0f0f0u) >> 4;
    x = (x & 0x33333333u) << 2 | (x & 0xccccccccu) >> 2;
    return (x & 0x55555555u) << 1 | (x & 0xaaaaaaaau) >> 1;
  }

  /// The product with Pascal's triangle mod 2, which generates the second Sobol' dimension when its
  /// bits are reversed: bit k is the sum of the bits n for which C(n, k) is odd.
  __attribute__((always_inline)) static std::uint32_t pascal(std::uint32_t x)
  {
    x ^= (x & 0xaaaaaaaau) >> 1;
    x ^= (x & 0xccccccccu) >> 2;
    x ^= (x & 0xf0f0f0f0u) >> 4;
    x ^= (x & 0xff00ff00u) >> 8;
    return x ^ (x & 0xffff0000u) >> 16;
  }

  /// A permutation in which a bit depends only on lower ones: a nested scramble of reversed bits.
  __attribute__((always_inline)) static std::uint32_t permuted(std::uint32_t x, std::uint32_t seed)
  {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    return x ^ x * 0x53a22864u;
  }
};

/// Numbers that have nothing to do with these.
inline std::array<double, 2> otherSquare(const std::array<double, 2>& u)
{
  const std::uint64_t first = splitMix(bitCast<std::uint64_t>(u[0])),
                      second = splitMix(first ^ bitCast<std::uint64_t>(u[1]));
  return { SobolPoint::toUnit(static_cast<std::uint32_t>(second)),
    SobolPoint::toUnit(static_cast<std::uint32_t>(second >> 32)) };
}

}
