// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_CellLook_h
#define irradiance_CellLook_h

#include <cmath>
#include <cstdint>

namespace irradiance
{

/**
 * What a walk needs of the cell of a triangle, in 8 bytes: which one it is, and whether the walk
 * survives, decided on the integer that a sample is made of.
 *
 * A sample c stands for (c + 1/2) / 2^32, see SobolPoint::toUnit(). Twice that is an integer below
 * 2^33, so a double holds it, as it does r = 2^32 times a reflectance. Hence `sample < reflectance`
 * means c < r - 1/2, and for integers c < N, with N the difference rounded up. The difference of
 * doubles is exact for r >= 1/4 (up to 1 by Sterbenz, beyond as it needs no finer bits than r), and
 * negative below, as the true one is. N = 2^32, which all samples are below, has no room in 32 bits
 * and is a bit of its own.
 */
struct CellLook
{
  /// Bits of `cell` beside the number.
  static constexpr std::uint32_t kSurvivesAlways = 1u << 31, kIsGlossy = 1u << 30;
  static constexpr std::uint32_t kNumber = kIsGlossy - 1;

  std::uint32_t cell;      ///< number among the cells of all objects, and the bits above
  std::uint32_t threshold; ///< a walk survives if its sample is below, or always

  CellLook() = default;
  /// `reflectance`: in all; with several bands it depends on the walk, and is not used.
  CellLook(std::uint32_t number, double reflectance, bool isGlossy)
    : cell(number | (isGlossy ? kIsGlossy : 0u))
    , threshold(0)
  {
    constexpr double kAll = 0x1p32;
    const double surviving = std::ceil(kAll * reflectance - 0.5);
    if (surviving >= kAll)
    {
      cell |= kSurvivesAlways;
    }
    else if (surviving > 0)
    {
      threshold = static_cast<std::uint32_t>(surviving);
    }
  }

  std::uint32_t number() const { return cell & kNumber; }
  bool isGlossy() const { return (cell & kIsGlossy) != 0; }
  bool survives(std::uint32_t sample) const
  {
    return sample < threshold || (cell & kSurvivesAlways) != 0;
  }
};
static_assert(sizeof(CellLook) == 8);

}

#endif
