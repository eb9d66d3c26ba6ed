// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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
 * as that light is direct; but foundLamps() count, and behind a specular reflection all do, as no
 * sum knows of it; with a weight if it was asked there as well.
 */
class PathSums
{
public:
  PathSums() = default;
  /// Irradiance, in quanta/m2. Each start has scene.rays of the paths, in order.
  PathSums(const FinalGatherScene& scene, const FollowedPaths& paths)
    : replicates_(scene.replicates())
    , sums_(paths.size() / scene.rays * replicates_)
    , differences_(scene.tellsNoise ? sums_.size() : 0)
    , stale_(paths.size() / scene.rays)
  {
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
  /// Of a path in the difference of halves: 1, -1, or 0 in the middle.
  static double signOf(std::uint32_t path, std::uint32_t paths)
  {
    return path < paths / 2 ? 1 : path >= (paths + 1) / 2 ? -1 : 0;
  }
  static SceneCell cellOf(const FinalGatherScene& scene, const PathSegment& segment)
  {
    return scene.known.cellOf(scene.frame.triangles.idOf(segment.triangle));
  }
  /// Whether what a cell emits counts where a path hits it.
  static bool isMetLamp(const FinalGatherScene& scene, const PathSegment& segment)
  {
    return segment.isFront &&
      (segment.isSpecular ||
        (!scene.foundLamps.empty() &&
          scene.foundLamps[scene.frame.cells.numbers()[cellOf(scene, segment)]]));
  }
  /// The direction in which light comes along a segment.
  static Vector3 backAlong(const PathSegment& segment)
  {
    const auto vector = [](const std::array<float, 3>& v) { return Vector3(v[0], v[1], v[2]); };
    return (vector(segment.from) - vector(segment.to)).normalized();
  }
  /// From a cell of which something is known.
  static void addKnown(const FinalGatherScene& scene, const PathSegment& segment,
    const Bands& weight, std::uint32_t replicate, Bands& sum, Bands& stale)
  {
    const TriangleId id = scene.frame.triangles.idOf(segment.triangle);
    const Material& material = *scene.frame.objects[id.object].material;
    const CellSide side{ scene.known.cellOf(id), segment.isFront ? 0 : 1 };
    const CellSums& sums = segment.isKnown ? scene.known : *scene.knownDirect;
    const double area = scene.frame.cells.area(side);
    // A sheet also sends what arrives behind it.
    for (int other = 0; other < (material.transmitsDiffusely(side.cell) ? 2 : 1); ++other)
    {
      const CellSide from{ side, other == 0 ? side.side : 1 - side.side };
      for (int band = 0; band < scene.known.bands(); ++band)
      {
        const auto i = static_cast<std::size_t>(band);
        const double sent = other == 0 ? material.reflectanceOf(id.triangle, band)
                                       : material.partOf(Leaving::DiffuseThrough, side.cell, 1)[i];
        const double part = weight[i] * sent / area;
        sum[i] += part * sums.sum(from, band, replicate, scene.knownRounds);
        if (segment.isKnown && scene.knownStale)
        {
          stale[i] += part / scene.replicates() * scene.knownStale->sum(from, band);
        }
      }
    }
  }
  /// What the sky sends along a path that escapes: as of a lamp, the exitance with its radiance, W/m2.
  static Bands emittedBySky(const FinalGatherScene& scene, const PathSegment& escape)
  {
    const Vector3 towards = Vector3(escape.to[0], escape.to[1], escape.to[2]).normalized();
    return kPi * scene.sky->distant()->radiancePerWatt(towards) * scene.sky->flux;
  }
  /// What a path brings to a replicate.
  static void add(const FinalGatherScene& scene, const FollowedPaths::Path& path,
    std::uint32_t replicate, Bands& sum, Bands& stale)
  {
    const int bands = scene.known.bands();
    const double quantaPerWatt = scene.quantaPerWatt / scene.replicates();
    const double* value = path.values;
    Bands weight{ 1.0 / scene.raysOfReplicate() };
    bool countsSky = scene.sky != nullptr, countedSky = countsSky;
    const auto addEmitted = [&](const Bands& emitted, double part) {
      for (int band = 0; band < bands; ++band)
      {
        const auto i = static_cast<std::size_t>(band);
        sum[i] += part * weight[i] * emitted[i] * quantaPerWatt;
      }
    };
    for (const PathSegment* segment = path.begin; segment != path.end; ++segment)
    {
      const bool isHit = segment->triangle != SceneTriangles::kNone;
      if (bands > 1 && (isHit || scene.sky))
      {
        std::copy_n(value, bands, weight.begin());
        value += bands;
      }
      // To clear sheets on its way a path pays no heed.
      countsSky = segment->isStraight ? countedSky : countsSky;
      if (!isHit)
      {
        if (countsSky)
        {
          addEmitted(emittedBySky(scene, *segment), 1);
        }
        return;
      }
      countedSky = countsSky;
      countsSky = scene.sky && !segment->isDirectKnown; // what is known has that of the sky in it
      if (segment->isKnown || segment->isDirectKnown)
      {
        addKnown(scene, *segment, weight, replicate, sum, stale);
      }
      for (int band = 0; segment->asksLights && band < bands; ++band)
      {
        sum[static_cast<std::size_t>(band)] += *value++ * quantaPerWatt;
      }
      const double lampWeight = segment->hasLampWeight ? *value++ : 1;
      if (isMetLamp(scene, *segment))
      {
        const SceneCell cell = cellOf(scene, *segment);
        addEmitted(emittedFrom(scene.frame.objects[cell.object], cell.cell, segment->isFront,
                     backAlong(*segment)),
          lampWeight);
      }
    }
  }

  std::uint32_t replicates_ = 1;
  std::vector<Bands> sums_, differences_, stale_;
};

}
