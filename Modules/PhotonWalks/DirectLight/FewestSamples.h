// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_FewestSamples_h
#define irradiance_FewestSamples_h

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace irradiance
{

/// With how many samples cells gather direct light at least; rounded up.
struct FewestSamples
{
  std::uint32_t small = 4; ///< >= 1
  std::uint32_t large = 4; ///< of cells that may receive four walks or more for each of `small`
  /// In place of `small` if there are few cells, for a share of the time that the walks take; 0:
  /// not decided.
  std::uint32_t mostOfSmall = 0;

  /// If not decided: as many as pay in the end, as of static cells, which gather once.
  FewestSamples asMany() const { return with(64); }
  /// If not decided: as what walks bring is noisy as well, as many as lights of this variance of a
  /// sample, see DirectPilot, need beside it.
  FewestSamples atVariance(double variance) const
  {
    constexpr double kLeast = 8, kMost = 32;
    return with(static_cast<std::uint32_t>(std::clamp(160 * std::sqrt(variance), kLeast, kMost)));
  }

  friend bool operator==(const FewestSamples& a, const FewestSamples& b)
  {
    return a.small == b.small && a.large == b.large && a.mostOfSmall == b.mostOfSmall;
  }

private:
  FewestSamples with(std::uint32_t most) const
  {
    return { small, large, mostOfSmall > 0 ? mostOfSmall : most };
  }
};

}

#endif
