// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_KnownLight_h
#define irradiance_KnownLight_h

#include "Tally/CellSums.h"

namespace irradiance
{

/// What cells are known to receive before a final gather, by side: one light would leak to the
/// other where bodies stick into each other.
struct KnownLight
{
  const CellSums& all; ///< of cells that are read
  /// Direct light of all other cells; null: they know none.
  const CellSums* direct;
  const CellSums* stale; ///< the part of `all` that rests on stale walks, in one replicate; or null
  std::size_t rounds;    ///< of `all` and `direct` that count
};

}

#endif
