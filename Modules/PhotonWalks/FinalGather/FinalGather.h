// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Execution/Execution.h"
#include "FinalGather/FinalGatherMotion.h"
#include "FinalGather/FinalGatherPaths.h"
#include "FinalGather/PathSums.h"
#include "Sampling/WalkPlan.h"

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

namespace irradiance
{

/**
 * The indirect light of all cells that gather, by side, in quanta. It is a pure function of the
 * scene, the seed and what is known: each replicate's rays read that replicate's own sums. All
 * threads and ranks share the work.
 *
 * Paths are kept: in a frame in which things have moved those are followed anew that start on what
 * moved, hit it, or that it may hide; and the light of all others is read again.
 */
class FinalGather
{
public:
  /// To a frame, by the first `rounds` rounds of rays, see FinalGatherScene::inRound(); paths of
  /// further ones are kept. `scene`: with the rays of the first. Throws Interrupted, and what
  /// FinalGatherPaths::follow() throws; after that nothing is kept.
  void update(const FinalGatherScene& scene, std::size_t rounds, Execution& execution);
  /// Forgets the paths of all but the first rounds.
  void dropRounds(std::size_t kept);

  /// Of replicates as those of the sums that are known, in one round; the same on all ranks.
  const CellSums& indirect() const { return indirect_; }
  /// The part that rests on stale walks, in one replicate; nothing if none are known.
  const CellSums& stale() const { return stale_; }
  /// The standard deviation of what a side receives, in all replicates together, which comes of the
  /// rays alone; by side, quanta. Nothing if the scene tells no noise.
  const CellSums& noise() const { return noise_; }
  /// Of what is kept.
  std::size_t bytes() const;
  /// Paths that the last update followed.
  std::int64_t numberFollowed() const { return followed_; }
  /// Segments of all paths that the last update read, of all ranks.
  std::int64_t segments() const { return segments_; }

private:
  struct Side
  {
    std::size_t gatherer;
    int side;
    std::uint32_t starts; ///< each with scene.rays paths

    bool operator==(const Side& other) const
    {
      return gatherer == other.gatherer && side == other.side && starts == other.starts;
    }
  };

  /// Sides of gatherers that follow each other, whose rays are cast together, and their paths, by
  /// round.
  struct Unit
  {
    std::vector<Side> sides;
    std::vector<FollowedPaths> rounds;
  };
  using Rounds = std::vector<FinalGatherScene>; ///< the scene, with the rays of each round

  std::vector<Side> sidesOf(const FinalGatherScene& scene, std::size_t unit) const;
  /// Of a unit: follows all `rounds`, and reads the first so many.
  void gather(
    const Rounds& rounds, std::size_t read, const FinalGatherMotion* motion, std::size_t unit);
  /// Follows again the paths of a round that may have changed, all if nothing is kept.
  void follow(const FinalGatherScene& scene, const FinalGatherMotion* motion,
    const std::vector<Side>& sides, FollowedPaths& paths);
  /// `brought`: by round. `start`: the first of the side's.
  void store(const FinalGatherScene& scene, const std::vector<PathSums>& brought, std::size_t start,
    const Side& side);
  /// See noise().
  void storeNoise(const FinalGatherScene& scene, const std::vector<PathSums>& brought,
    std::size_t start, const Side& side);

  std::vector<SceneCell> gatherers_;
  std::vector<Unit> units_;
  DealtBlocks dealt_; ///< the units of this rank
  std::size_t keptRounds_ = 0;
  std::optional<PathsOrigin> origin_;                   ///< of the paths that are kept
  Pool<FinalGatherPaths> paths_;                        ///< what threads work with
  Pool<FollowedPaths> forgotten_;                       ///< of which the memory is left
  std::atomic<std::int64_t> followed_{ 0 }, read_{ 0 }; ///< of this rank: paths, segments
  std::int64_t segments_ = 0;
  CellSums indirect_, stale_, noise_;
};

}
