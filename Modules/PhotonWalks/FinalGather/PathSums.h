// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PathSums_h
#define irradiance_PathSums_h

#include "FinalGather/FinalGatherScene.h"
#include "FinalGather/FollowedPaths.h"

#include <algorithm>
#include <vector>

namespace irradiance
{

/**
 * The light that paths bring to their starts, from what is known of the cells that they hit.
 *
 * From a cell that is read: what its side received, times its reflectance. From any other cell:
 * what came to it straight from the lights that cells look for. A lamp that is met brings nothing,
 * as that light is direct; but foundLamps() count, and behind a specular reflection all do, as no sum
 * knows of it; with a weight if it was asked there as well.
 */
class PathSums
{
public:
  /// Irradiance, in quanta/m2.
  /// `starts`: each has scene.rays of the paths, in order.
  void read(const FinalGatherScene& scene, const FollowedPaths& paths, std::size_t starts);

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
  /// Where a path hit something.
  struct Asked
  {
    const double* brought = nullptr; ///< by the lights, W/m2 by band, if they were asked there
    double lampWeight = 1;           ///< of a lamp that was hit, as it may have been asked as well
  };
  /// Calls visit(segment, weight, Asked) for all that hit something.
  template <class Visit>
  static void forEachHit(
    const FinalGatherScene& scene, const FollowedPaths::Path& path, const Visit& visit);
  static void add(const FinalGatherScene& scene, const FollowedPaths::Path& path,
    std::uint32_t replicate, Bands& sum, Bands& stale);
  static void addKnown(const FinalGatherScene& scene, const PathSegment& segment,
    const Bands& weight, std::uint32_t replicate, Bands& sum, Bands& stale);
  static void addEmitted(const FinalGatherScene& scene, const PathSegment& segment,
    const Bands& weight, double lampWeight, Bands& sum);

  std::uint32_t replicates_ = 1;
  std::vector<Bands> sums_, differences_, stale_;
};

template <class Visit>
void PathSums::forEachHit(
  const FinalGatherScene& scene, const FollowedPaths::Path& path, const Visit& visit)
{
  const int bands = scene.known.all.bands();
  const double* value = path.values;
  Bands weight{ 1.0 / scene.raysOfReplicate() };
  for (const PathSegment* segment = path.begin;
       segment != path.end && segment->triangle != PathSegment::kNone; ++segment)
  {
    if (bands > 1)
    {
      std::copy_n(value, bands, weight.begin());
      value += bands;
    }
    Asked asked;
    if (segment->asksLights)
    {
      asked.brought = value;
      value += bands;
    }
    if (segment->hasLampWeight)
    {
      asked.lampWeight = *value++;
    }
    visit(*segment, weight, asked);
  }
}

}

#endif
