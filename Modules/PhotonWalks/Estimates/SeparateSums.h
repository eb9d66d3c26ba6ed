// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SeparateSums_h
#define irradiance_SeparateSums_h

#include "Walks/WalkSets.h"

#include <optional>

namespace irradiance
{

/// What cells received in some rounds, taken apart by the way in which it is known. Both sums have one round.
struct SeparateSums
{
  CellSums direct;   ///< gathered
  CellSums indirect; ///< brought by walks
};

/// What cells gathered in all rounds; nothing if no cell gathers. All ranks have the same.
std::optional<CellSums> gatheredSums(
  const WalkSets& walks, const SceneObjects& objects, const CancelPoint& cancelPoint);

/// Of the first `rounds` rounds; nothing if no cell gathers. All ranks have the same.
std::optional<SeparateSums> separateSums(
  const WalkSets& walks, const SceneObjects& objects, std::size_t rounds, Execution& execution);

}

#endif
