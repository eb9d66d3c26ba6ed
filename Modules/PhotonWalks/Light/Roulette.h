// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Roulette_h
#define irradiance_Roulette_h

#include "Light/Power.h"

namespace irradiance
{

/// Roulette begins when a walk is weaker than a quarter of what it started with.
inline std::int64_t rouletteThreshold(const Power& first)
{
  return first.largest() / 4;
}

/**
 * Russian roulette (Arvo and Kirk 1990): a walk weaker than `threshold` survives with probability
 * power / threshold, and then has the power `threshold`. So the mean is kept, and no walk is cut
 * off. `u` is uniform in (0, 1). Several bands keep their ratios; the strongest one counts.
 */
inline Power playRoulette(const Power& power, std::int64_t threshold, double u)
{
  const std::int64_t strongest = power.largest();
  if (strongest >= threshold)
  {
    return power;
  }
  if (!(u * static_cast<double>(threshold) < static_cast<double>(strongest)))
  {
    return {};
  }
  Power survivor;
  const __int128 divisor = strongest;
  for (int band = 0; band < Power::kMaxBands; ++band)
  {
    const __int128 scaled = static_cast<__int128>(power[band]) * threshold;
    survivor[band] = static_cast<std::int64_t>((2 * scaled + divisor) / (2 * divisor)); // rounded
  }
  return survivor;
}

}

#endif
