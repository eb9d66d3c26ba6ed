// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_FinalGather_h
#define irradiance_FinalGather_h

#include "Execution/Execution.h"
#include "Execution/Pool.h"
#include "FinalGather/GatherPaths.h"

#include <vector>

namespace irradiance
{

/// The indirect light of all cells that gather, by side, in quanta. It is a pure function of the scene, the
/// seed and what is known: each replicate's rays read that replicate's own sums. All threads and ranks share the
/// work.
class FinalGather
{
public:
  /// Throws Interrupted, and what GatherPaths::run() throws.
  FinalGather(const GatherScene& scene, Execution& execution);

  /// Of replicates as those of the sums that are known, in one round; the same on all ranks.
  const CellSums& indirect() const { return indirect_; }
  /// The part that rests on stale walks, in one replicate; nothing if none are known.
  const CellSums& stale() const { return stale_; }

private:
  struct Gatherer
  {
    SceneCell cell;
    std::size_t shape;
  };
  void gather(const GatherScene& scene, std::size_t first, std::size_t end);
  void store(
    const GatherScene& scene, const GatherPaths& paths, std::size_t number, const CellSide& side);

  std::vector<Gatherer> gatherers_;
  Pool<GatherPaths> paths_; ///< what threads work with
  CellSums indirect_, stale_;
};

}

#endif
