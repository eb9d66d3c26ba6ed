// SPDX-License-Identifier: BSD-3-Clause
#ifndef Random_h
#define Random_h

#include <array>
#include <cstdint>

namespace pathtracedroom
{

/**
 * A stream of independent numbers, uniform in (0, 1). Number i is a pure function of seed, pass,
 * stream and i, so that paths draw the same numbers in whichever order and thread they are traced.
 * It mixes as SplitMix64 does (Steele, Lea and Flood 2014).
 */
class Random
{
public:
  Random() = default;
  Random(std::uint64_t seed, std::uint64_t pass, std::uint64_t stream)
    : key_(mixed(mixed(mixed(seed) + pass) + stream))
  {
  }

  double next()
  {
    return (static_cast<double>(mixed(key_ + mixed(++count_)) >> 12) + 0.5) * 0x1p-52;
  }
  /// A point of the unit square.
  std::array<double, 2> nextPair()
  {
    const double first = next();
    return { first, next() };
  }

private:
  static std::uint64_t mixed(std::uint64_t x)
  {
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
  }

  std::uint64_t key_ = 0;
  std::uint64_t count_ = 0;
};

}

#endif
