// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

/// Draws an index in proportion to its weight, in the same few steps for any number of them (Vose
/// 1991, "A linear algorithm for generating random numbers with a given distribution").
class AliasTable
{
public:
  /// `weights`: >= 0, with a sum > 0; at most 2^24 of them, as a float draws.
  explicit AliasTable(const std::vector<double>& weights)
    : entries_(weights.size())
  {
    const double mean =
      std::accumulate(weights.begin(), weights.end(), 0.0) / static_cast<double>(weights.size());
    std::vector<double> shares;
    std::vector<std::uint32_t> small, large;
    for (std::uint32_t i = 0; i < weights.size(); ++i)
    {
      shares.push_back(weights[i] / mean);
      entries_[i] = { 1, { i, i } }; // what remains at the end, where shares are 1 but for rounding
      (shares[i] < 1 ? small : large).push_back(i);
    }
    while (!small.empty() && !large.empty())
    {
      const std::uint32_t poor = small.back(), rich = large.back();
      small.pop_back();
      entries_[poor] = { static_cast<float>(shares[poor]), { rich, poor } };
      shares[rich] -= 1 - shares[poor];
      if (shares[rich] < 1)
      {
        large.pop_back();
        small.push_back(rich);
      }
    }
  }

  /// `place` and `choice`: uniform in [0, 1), in steps of 2^-24. (A product with a size up to 2^24
  /// then does not round up to the size.)
  std::uint32_t draw(float place, float choice) const
  {
    const Entry& entry =
      entries_[static_cast<std::uint32_t>(place * static_cast<float>(entries_.size()))];
    return entry.index[choice < entry.share]; // no branch on what is as good as random
  }

private:
  struct Entry
  {
    float share; ///< of the second index
    std::uint32_t index[2];
  };

  std::vector<Entry> entries_;
};
