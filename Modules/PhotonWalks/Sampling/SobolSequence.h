// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SobolSequence_h
#define irradiance_SobolSequence_h

#include "Sampling/WalkPlan.h"

#include <array>

namespace irradiance
{

/// What a sample of a bounce is used for; each use has a two-dimensional pattern of its own.
enum class SampleUse : std::uint32_t
{
  Emitter,   ///< which light (first coordinate)
  Position,  ///< where on it
  Direction, ///< in which direction the walk leaves
  Survival   ///< whether the walk leaves the hit before this bounce (first coordinate)
};

/**
 * Randomized quasi-Monte-Carlo samples as a pure function of (seed, walk, bounce, use): the first
 * two Sobol' dimensions, their index shuffled and each coordinate scrambled by hash-based nested
 * uniform (Owen) scrambling. Every pair is a (0,2)-sequence in the walks, pairs are independent,
 * and the depth is not limited. After Burley, "Practical Hash-based Owen Scrambling" (JCGT 2020),
 * with the hash of Vegdahl (2021). Coordinates are multiples of 2^-32 plus 2^-33, so never 0 or 1.
 *
 * Each replicate has a scrambling of its own and runs through the sequence from its start, so that
 * the estimates of replicates are independent. The first replicate has the scrambling of the seed.
 */
class SobolSequence
{
public:
  explicit SobolSequence(std::uint64_t seed, const Replicates& replicates = Replicates())
    : replicates_(replicates)
    , seeds_{ seed }
  {
    for (std::uint32_t replicate = 1; replicate < replicates.count(); ++replicate)
    {
      seeds_.push_back(mix(mix(seed) + replicate));
    }
  }

  std::array<double, 2> sample(std::uint32_t walk, std::uint32_t bounce, SampleUse use) const
  {
    const std::uint64_t seed = seeds_[replicates_.replicateOf(walk)];
    const std::uint64_t key =
      mix(seed ^ mix(std::uint64_t{ bounce } << 32 | static_cast<std::uint32_t>(use)));
    const std::uint64_t scrambles = mix(key);
    const std::uint32_t index =
      scrambled(replicates_.numberWithin(walk), static_cast<std::uint32_t>(key));
    // The first dimension reverses the bits of the index; scrambling reverses them once more.
    return { toUnit(reversed(permuted(index, static_cast<std::uint32_t>(scrambles)))),
      toUnit(reversed(permuted(pascal(index), static_cast<std::uint32_t>(scrambles >> 32)))) };
  }

  /// Bits in reverse order: van der Corput's radical inverse as a fixed-point number.
  static std::uint32_t reversed(std::uint32_t x)
  {
    x = x << 16 | x >> 16;
    x = (x & 0x00ff00ffu) << 8 | (x & 0xff00ff00u) >> 8;
    x = (x & 0x0f0f0f0fu) << 4 | (x & 0xf0f0f0f0u) >> 4;
    x = (x & 0x33333333u) << 2 | (x & 0xccccccccu) >> 2;
    return (x & 0x55555555u) << 1 | (x & 0xaaaaaaaau) >> 1;
  }

  /// The product with Pascal's triangle mod 2, which generates the second Sobol' dimension when its
  /// bits are reversed: bit k is the sum of the bits n for which C(n, k) is odd.
  static std::uint32_t pascal(std::uint32_t x)
  {
    x ^= (x & 0xaaaaaaaau) >> 1;
    x ^= (x & 0xccccccccu) >> 2;
    x ^= (x & 0xf0f0f0f0u) >> 4;
    x ^= (x & 0xff00ff00u) >> 8;
    return x ^ (x & 0xffff0000u) >> 16;
  }

private:
  /// A permutation in which a bit depends only on lower ones: a nested scramble of reversed bits.
  static std::uint32_t permuted(std::uint32_t x, std::uint32_t seed)
  {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    return x ^ x * 0x53a22864u;
  }

  static std::uint32_t scrambled(std::uint32_t x, std::uint32_t seed)
  {
    return reversed(permuted(reversed(x), seed));
  }

  /// SplitMix64's finalizer (Steele, Lea and Flood 2014).
  static std::uint64_t mix(std::uint64_t x)
  {
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
    x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    return x ^ x >> 31;
  }

  static double toUnit(std::uint32_t x) { return (x + 0.5) * 0x1p-32; }

  Replicates replicates_;
  std::vector<std::uint64_t> seeds_; ///< of each replicate
};

}

#endif
