// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

/// Marsaglia's generator with 128 bits of state (2003, "Xorshift RNGs"), one for each lane.
template <int width>
class XorShift
{
public:
  explicit XorShift(std::uint64_t seed)
  {
    for (auto& word : state_)
    {
      for (std::uint32_t& lane : word)
      {
        lane = static_cast<std::uint32_t>(splitMix(seed) >> 32);
      }
    }
  }

  /// Uniform in [0, 1), in steps of 2^-24.
  void next(float* uniform)
  {
    for (int k = 0; k < width; ++k)
    {
      const std::uint32_t first = state_[0][k] ^ (state_[0][k] << 11), last = state_[3][k];
      state_[0][k] = state_[1][k];
      state_[1][k] = state_[2][k];
      state_[2][k] = last;
      state_[3][k] = last ^ (last >> 19) ^ first ^ (first >> 8);
      uniform[k] = static_cast<float>(static_cast<std::int32_t>(state_[3][k] >> 8)) * 0x1p-24f;
    }
  }

private:
  /// Turns any seed, and each that follows it, into bits without a pattern (Steele et al. 2014).
  static std::uint64_t splitMix(std::uint64_t& seed)
  {
    std::uint64_t z = (seed += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  alignas(64) std::uint32_t state_[4][width];
};
