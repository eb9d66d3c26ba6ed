// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SideSums_h
#define irradiance_SideSums_h

#include "Walks/WalkSets.h"

#include <optional>

namespace irradiance
{

/// What each side of the cells received, whether or not the sums of the walks tell sides apart: if
/// not, what all walks brought is counted once more, from what is stored of them.
class SideSums
{
public:
  /// All must outlive it. Without sums by side this rank needs all walks, stored. Throws
  /// Interrupted.
  SideSums(const WalkSets& walks, const SceneObjects& objects, Execution& execution);

  /// Of two sides, with the rounds and replicates of the walks.
  const CellSums& sums() const { return counted_ ? *counted_ : walks_.sums(); }

private:
  void count(const WalkSet& set, const SceneObjects& objects, Execution& execution);

  const WalkSets& walks_;
  std::optional<CellSums> counted_;
};

}

#endif
