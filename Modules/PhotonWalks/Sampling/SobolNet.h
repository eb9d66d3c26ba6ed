// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Sampling/SobolPoint.h"

#include <array>
#include <cstdint>

namespace irradiance
{

/**
 * Points of the first four Sobol' dimensions together, each coordinate with a nested uniform (Owen)
 * scrambling of its own. Where two SobolPoints are shuffled against each other, these fill the four
 * dimensions evenly as well, and with some hundred points estimate better what depends on all; but
 * a few points do so worse.
 *
 * Direction numbers from Joe and Kuo, "Constructing Sobol sequences with better two-dimensional
 * projections" (SIAM J. Sci. Comput. 30, 2008).
 */
class SobolNet
{
public:
  using Point = std::array<double, 4>;

  SobolNet() = default;
  /// From a hash.
  explicit SobolNet(std::uint64_t hash)
    : scrambles_(scramblesOf(hash))
  {
  }

  /// In (0, 1); multiples of 2^-32 plus 2^-33.
  Point inUnitCube(std::uint32_t index) const
  {
    // With their bits reversed, as scrambles take them.
    std::array<std::uint32_t, 4> coordinates{ index, SobolPoint::pascal(index), 0, 0 };
    for (std::uint32_t bit = 0, left = index; left != 0; ++bit, left >>= 1)
    {
      const std::uint32_t mask = 0u - (left & 1u);
      coordinates[2] ^= mask & kThird[bit];
      coordinates[3] ^= mask & kFourth[bit];
    }
    Point point{};
    for (std::size_t i = 0; i < point.size(); ++i)
    {
      point[i] = SobolPoint::toUnit(
        SobolPoint::reversed(SobolPoint::permuted(coordinates[i], scrambles_[i])));
    }
    return point;
  }

private:
  using Directions = std::array<std::uint32_t, 32>;

  /// The directions of a primitive polynomial of this degree, its inner terms as the bits of a
  /// number, from its first numbers.
  static constexpr Directions directions(
    std::size_t degree, std::uint32_t inner, std::array<std::uint32_t, 3> first)
  {
    Directions numbers{};
    for (std::size_t k = 0; k < numbers.size(); ++k)
    {
      if (k < degree)
      {
        numbers[k] = first[k];
        continue;
      }
      numbers[k] = numbers[k - degree] ^ numbers[k - degree] << degree;
      for (std::size_t i = 1; i < degree; ++i)
      {
        numbers[k] ^= (inner >> (degree - 1 - i) & 1u) * (numbers[k - i] << i);
      }
    }
    // Number k has k + 1 binary digits after the point; its bits in reverse order.
    for (std::size_t k = 0; k < numbers.size(); ++k)
    {
      std::uint32_t turned = 0;
      for (std::size_t digit = 0; digit <= k; ++digit)
      {
        turned |= (numbers[k] >> (k - digit) & 1u) << digit;
      }
      numbers[k] = turned;
    }
    return numbers;
  }

  static std::array<std::uint32_t, 4> scramblesOf(std::uint64_t hash)
  {
    const SampleKeys first(splitMix(hash)), second(splitMix(hash + 1));
    return { first.scrambles[0], first.scrambles[1], second.scrambles[0], second.scrambles[1] };
  }

  static const Directions kThird, kFourth;

  std::array<std::uint32_t, 4> scrambles_{};
};

inline constexpr SobolNet::Directions SobolNet::kThird = SobolNet::directions(2, 1, { 1, 3, 0 });
inline constexpr SobolNet::Directions SobolNet::kFourth = SobolNet::directions(3, 1, { 1, 3, 1 });

}
