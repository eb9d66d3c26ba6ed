// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PathSums_h
#define irradiance_PathSums_h

#include "FinalGather/FinalGatherScene.h"
#include "FinalGather/FollowedPaths.h"

#include <vector>

namespace irradiance
{

/**
 * The light that paths bring to their starts, from what is known of the cells that they hit.
 *
 * From a cell that is read: what its side received, times its reflectance. From any other cell:
 * what came to it straight from the lights that cells look for. A lamp that is met brings nothing,
 * as that light is direct; but foundLamps() count, and behind a specular reflection all do, as no
 * sum knows of it; with a weight if it was asked there as well.
 */
class PathSums
{
public:
  PathSums() = default;
  /// Irradiance, in quanta/m2. Each start has scene.rays of the paths, in order.
  PathSums(const FinalGatherScene& scene, const FollowedPaths& paths);

  /// What a replicate found.
  const Bands& found(std::size_t start, std::uint32_t replicate) const
  {
    return sums_[start * replicates_ + replicate];
  }
  /// By how much more the first half of its rays found than the second, if the scene tells noise:
  /// noise of the rays alone, as both read the same sums. Nothing of a single ray.
  const Bands& difference(std::size_t start, std::uint32_t replicate) const
  {
    return differences_[start * replicates_ + replicate];
  }
  /// What of all replicates' together rests on stale walks.
  const Bands& stale(std::size_t start) const { return stale_[start]; }

private:
  std::uint32_t replicates_ = 1;
  std::vector<Bands> sums_, differences_, stale_;
};

}

#endif
