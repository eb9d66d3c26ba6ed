// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PathSums_h
#define irradiance_PathSums_h

#include "FinalGather/FollowedPaths.h"
#include "FinalGather/GatherScene.h"

#include <array>
#include <vector>

namespace irradiance
{

/**
 * The light that paths bring to their starts, from what is known of the cells that they hit.
 *
 * From a cell that is read: what its side received, times its reflectance. From any other cell: what came to it straight
 * from the lights. A lamp that is met brings nothing, as that light is direct; but behind a specular reflection it
 * counts, as no sum knows of it; with a weight if it was asked there as well.
 */
class PathSums
{
public:
  /// Irradiance, in quanta/m2.
  using Bands = std::array<double, Power::kMaxBands>;

  /// `starts`: each has scene.rays of the paths, in order.
  void read(const GatherScene& scene, const FollowedPaths& paths, std::size_t starts);

  /// What a replicate found.
  const Bands& found(std::size_t start, std::uint32_t replicate) const
  {
    return sums_[start * replicates_ + replicate];
  }
  /// What of all replicates' together rests on stale walks.
  const Bands& stale(std::size_t start) const { return stale_[start]; }

private:
  void add(const GatherScene& scene, const FollowedPaths::Path& path, std::uint32_t replicate,
    Bands& sum, Bands& stale) const;
  void addKnown(const GatherScene& scene, const GatherSegment& segment, const Bands& weight,
    std::uint32_t replicate, Bands& sum, Bands& stale) const;

  std::uint32_t replicates_ = 1;
  int bands_ = 1;
  std::vector<Bands> sums_, stale_;
};

}

#endif
