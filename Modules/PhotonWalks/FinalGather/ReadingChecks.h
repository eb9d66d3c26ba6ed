// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_ReadingChecks_h
#define irradiance_ReadingChecks_h

#include "FinalGather/GatherMotion.h"
#include "FinalGather/GatherPaths.h"
#include "FinalGather/PathSums.h"

#include <cstdint>
#include <vector>

namespace irradiance
{

/**
 * How much too much light paths bring because they read the means of cells. Some readings are
 * checked: the light at the point that the path hit is compared with that at a point anywhere on
 * the same side of the cell, which is the mean in expectation. Both are gathered with the same
 * samples, so most noise is the same, and the difference is nearly that of the places alone. The
 * light of both comes by paths that read cells again; the little that differs in the biases of
 * these is left out.
 *
 * All is a pure function of the scene, the seed, the sums, and the paths and numbers of the starts.
 * Checks are kept as paths are: those of a path that was followed anew are made anew, and those
 * that a motion may change.
 */
class ReadingChecks
{
public:
  /// One path of so many is checked: this takes some tenth of the time of all.
  static constexpr std::uint32_t kPeriod = 64;

  struct Start
  {
    std::uint64_t number; ///< chooses which of its paths are checked, and the samples
    double area;          ///< on which it receives, m2
  };
  /// Which of the checks of before may be kept.
  struct Kept
  {
    const GatherMotion* motion; ///< since then; null: none is kept
    /// Of each path, FollowedPaths::kAnew if it was followed anew.
    const std::vector<std::size_t>& places;
  };

  /// To the readings of all starts, each with scene.rays of the paths, in order. `following`: what
  /// it works with. Returns how many paths were followed for them.
  std::int64_t update(const GatherScene& scene, const FollowedPaths& paths,
    const std::vector<Start>& starts, const Kept& kept, GatherPaths& following);
  /// What all starts receive too much in each replicate, in quanta of all bands together; unbiased.
  std::vector<double> excess(const GatherScene& scene) const;
  /// Of its memory.
  std::size_t bytes() const { return checks_.capacity() * sizeof(Check) + followed_.bytes(); }

private:
  struct Check
  {
    std::size_t path; ///< whose reading it is
    std::uint32_t ray;
    bool isKnown; ///< what is read is all light; else what came straight from the lights
    /// What of the light at a point arrives at the start, m2.
    PathSums::Bands weight;
    /// At a point anywhere less than at the hit, straight from the lights; W/m2.
    PathSums::Bands direct;
  };
  /// Of a check that is made anew.
  struct Points
  {
    std::size_t check;
    std::uint64_t number; ///< of both: chooses the samples
    LitPoint anywhere, hit;
  };
  /// Of each check: one without segments, which has the rays of lights to both points; from
  /// anywhere; and from the hit.
  static constexpr std::size_t kPathsOfCheck = 3;

  /// Takes over the checks of a path, if there is nothing that may have changed them.
  bool keep(const ReadingChecks& before, std::size_t path, const Kept& kept,
    std::vector<std::size_t>& places);
  Points addCheck(const GatherScene& scene, const GatherSegment& segment, Check check,
    std::uint64_t number, double area);
  FollowedPaths follow(
    const GatherScene& scene, const std::vector<Points>& anew, GatherPaths& following);
  /// Appends the rays to `rays`, if paths are kept.
  static PathSums::Bands directDifference(
    const GatherScene& scene, const Points& points, FollowedPaths& rays);

  std::vector<Check> checks_; ///< in the order of the paths
  FollowedPaths followed_;
};

}

#endif
