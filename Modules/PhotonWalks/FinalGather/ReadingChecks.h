// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_ReadingChecks_h
#define irradiance_ReadingChecks_h

#include "FinalGather/GatherPaths.h"
#include "FinalGather/PathSums.h"

#include <cstdint>
#include <vector>

namespace irradiance
{

/**
 * How much too much light paths bring because they read the means of cells. Some readings are checked: the light at the
 * point that the path hit is compared with that at a point anywhere on the same side of the cell, which is the mean in
 * expectation. Both are gathered with the same samples, so most noise is the same, and the difference is nearly that of the
 * places alone. The light of both comes by paths that read cells again; the little that differs in the biases of these
 * is left out.
 *
 * All is a pure function of the scene, the seed, the sums, and the paths and numbers of the starts.
 */
class ReadingChecks
{
public:
  /// One path of so many is checked: this takes some tenth of the time of all.
  static constexpr std::uint32_t kPeriod = 64;

  explicit ReadingChecks(const GatherScene& scene)
    : scene_(scene)
  {
  }

  /// The readings of a start's paths, the scene.rays paths from `first` on. `number`: chooses which, and the samples.
  /// `area`: on which the start receives, m2.
  void add(const FollowedPaths& paths, std::size_t first, std::uint64_t number, double area);
  /// What all starts that were added receive too much in each replicate, in quanta of all bands together; unbiased.
  std::vector<double> excess(GatherPaths& paths) const;

private:
  struct Check
  {
    std::uint32_t ray;
    std::uint64_t number; ///< of the points: chooses the samples
    bool isKnown;         ///< what is read is all light; else what came straight from the lights
    /// What of the light at a point arrives at the start, m2.
    PathSums::Bands weight;
    LitPoint hit, anywhere;
  };

  void addCheck(const GatherSegment& segment, std::uint32_t ray, std::uint64_t number, double area,
    const PathSums::Bands& weight);
  /// At `anywhere` less than at `hit`, straight from the lights; quanta/m2 of a replicate.
  PathSums::Bands directDifference(const Check& check) const;

  const GatherScene& scene_;
  std::vector<Check> checks_;
};

}

#endif
