// SPDX-License-Identifier: BSD-3-Clause
#include "FinalGather/PathSums.h"

#include <algorithm>

namespace irradiance
{

namespace
{

/// Of a path in the difference of halves: 1, -1, or 0 in the middle.
double signOf(std::uint32_t path, std::uint32_t paths)
{
  return path < paths / 2 ? 1 : path >= (paths + 1) / 2 ? -1 : 0;
}

SceneCell cellOf(const FinalGatherScene& scene, const PathSegment& segment)
{
  return scene.known.all.cellOf(scene.frame.triangles.idOf(segment.triangle));
}

}

void PathSums::read(const FinalGatherScene& scene, const FollowedPaths& paths, std::size_t starts)
{
  replicates_ = scene.replicates();
  sums_.assign(starts * replicates_, {});
  differences_.assign(scene.tellsNoise ? sums_.size() : 0, {});
  stale_.assign(starts, {});
  for (std::size_t i = 0; i < paths.size(); ++i)
  {
    const std::size_t start = i / scene.rays;
    const auto ray = static_cast<std::uint32_t>(i % scene.rays);
    const std::uint32_t replicate = ray / scene.raysOfReplicate();
    const std::size_t at = start * replicates_ + replicate;
    const Bands before = sums_[at];
    add(scene, paths[i], replicate, sums_[at], stale_[start]);
    const double sign = signOf(ray % scene.raysOfReplicate(), scene.raysOfReplicate());
    if (scene.tellsNoise)
    {
      differences_[at] += sign * (sums_[at] - before);
    }
  }
}

void PathSums::add(const FinalGatherScene& scene, const FollowedPaths::Path& path,
  std::uint32_t replicate, Bands& sum, Bands& stale)
{
  const double quantaPerWatt = scene.quantaPerWatt / scene.replicates();
  forEachHit(scene, path, [&](const PathSegment& segment, const Bands& weight, const Asked& asked) {
    if (segment.isKnown || segment.isDirectKnown)
    {
      addKnown(scene, segment, weight, replicate, sum, stale);
    }
    for (int band = 0; asked.brought && band < scene.known.all.bands(); ++band)
    {
      sum[static_cast<std::size_t>(band)] += asked.brought[band] * quantaPerWatt;
    }
    if (segment.isFront &&
      (segment.isSpecular ||
        (!scene.foundLamps.empty() &&
          scene.foundLamps[scene.frame.cells.numbers()[cellOf(scene, segment)]])))
    {
      addEmitted(scene, segment, weight, asked.lampWeight, sum);
    }
  });
}

void PathSums::addEmitted(const FinalGatherScene& scene, const PathSegment& segment,
  const Bands& weight, double lampWeight, Bands& sum)
{
  const SceneCell cell = cellOf(scene, segment);
  const double* const emitted =
    emittedFrom(scene.frame.objects[cell.object], cell.cell, segment.isFront);
  const double quantaPerWatt = scene.quantaPerWatt / scene.replicates();
  for (int band = 0; emitted && band < scene.known.all.bands(); ++band)
  {
    const auto i = static_cast<std::size_t>(band);
    sum[i] += lampWeight * weight[i] * emitted[i] * quantaPerWatt;
  }
}

void PathSums::addKnown(const FinalGatherScene& scene, const PathSegment& segment,
  const Bands& weight, std::uint32_t replicate, Bands& sum, Bands& stale)
{
  const TriangleId id = scene.frame.triangles.idOf(segment.triangle);
  const Material& material = *scene.frame.objects[id.object].material;
  const CellSide side{ { id.object, material.cellOfTriangle[id.triangle] },
    segment.isFront ? 0 : 1 };
  const KnownLight& known = scene.known;
  const CellSums& sums = segment.isKnown ? known.all : *known.direct;
  const double area = scene.frame.cells.area(side);
  for (int band = 0; band < known.all.bands(); ++band)
  {
    const auto i = static_cast<std::size_t>(band);
    const double reflected = weight[i] * material.reflectanceOf(id.triangle, band) / area;
    sum[i] += reflected * sums.sum(side, band, replicate, known.rounds);
    if (segment.isKnown && known.stale)
    {
      stale[i] += reflected / scene.replicates() * known.stale->sum(side, band);
    }
  }
}

}
