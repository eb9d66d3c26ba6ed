// SPDX-License-Identifier: BSD-3-Clause
#include "FinalGather/ReadingChecks.h"

#include "FinalGather/AreaPoints.h"
#include "Sampling/SobolPoint.h"

namespace irradiance
{

void ReadingChecks::add(
  const FollowedPaths& paths, std::size_t first, std::uint64_t number, double area)
{
  const std::uint64_t seed = splitMix(~scene_.seed ^ splitMix(number));
  for (std::uint32_t ray = 0; ray < scene_.rays; ++ray)
  {
    if (splitMix(seed + ray) % kPeriod != 0)
    {
      continue;
    }
    std::uint64_t hits = 0;
    PathSums::forEachHit(scene_, paths[first + ray],
      [&](const GatherSegment& segment, const PathSums::Bands& weight, const PathSums::Asked&) {
        ++hits;
        if (segment.isKnown || segment.isDirectKnown)
        {
          addCheck(
            segment, ray, splitMix(seed ^ splitMix(hits << 32 | ray)), kPeriod * area, weight);
        }
      });
  }
}

void ReadingChecks::addCheck(const GatherSegment& segment, std::uint32_t ray, std::uint64_t number,
  double area, const PathSums::Bands& weight)
{
  const SceneTriangles& triangles = scene_.space.triangles;
  const TriangleId id = triangles.idOf(segment.triangle);
  const Material& material = *scene_.objects[id.object].material;
  Check check{ ray, number, segment.isKnown, {}, {}, {} };
  for (int band = 0; band < scene_.known.all.bands(); ++band)
  {
    const auto i = static_cast<std::size_t>(band);
    check.weight[i] = area * weight[i] * material.reflectanceOf(id.triangle, band);
  }
  check.hit = LitPoint::onTriangle(triangleOf(triangles, segment.triangle), id, segment.isFront,
    Eigen::Vector3f(segment.to.data()).cast<double>());
  const std::size_t cell =
    scene_.cells.numbers()[{ id.object, material.cellOfTriangle[id.triangle] }];
  auto [place, on] = AreaPoints(scene_.shapes, triangles, cell)
                       .at(SobolPoint::inUnitSquare(ray, SampleKeys(splitMix(number))));
  place.turn(segment.isFront);
  check.anywhere = { place.clearPosition(), place.normal, on };
  checks_.push_back(check);
}

PathSums::Bands ReadingChecks::directDifference(const Check& check) const
{
  const double quantaPerWatt = scene_.quantaPerWatt / scene_.replicates();
  PathSums::Bands difference{};
  for (const PointDirectLight& lights : scene_.lights)
  {
    const PointDirectLight::Bands anywhere = lights.irradiance(check.anywhere, check.number),
                                  hit = lights.irradiance(check.hit, check.number);
    for (std::size_t band = 0; band < difference.size(); ++band)
    {
      difference[band] += quantaPerWatt * (anywhere[band] - hit[band]);
    }
  }
  return difference;
}

std::vector<double> ReadingChecks::excess(GatherPaths& paths) const
{
  paths.begin(scene_);
  for (const Check& check : checks_)
  {
    if (check.isKnown)
    {
      paths.addPoint(scene_, check.anywhere, check.number, { check.ray });
      paths.addPoint(scene_, check.hit, check.number, { check.ray });
    }
  }
  paths.run(scene_);
  std::vector<double> excess(scene_.replicates());
  std::size_t next = 0;
  for (const Check& check : checks_)
  {
    const std::uint32_t replicate = check.ray / scene_.raysOfReplicate();
    PathSums::Bands difference = directDifference(check);
    for (const double sign : { 1.0, -1.0 })
    {
      // A path brings its part of what those of the replicate bring together.
      const PathSums::Bands brought = check.isKnown
        ? PathSums::broughtBy(scene_, paths.followed()[next++], replicate)
        : PathSums::Bands{};
      for (std::size_t band = 0; band < difference.size(); ++band)
      {
        difference[band] += sign * scene_.raysOfReplicate() * brought[band];
      }
    }
    for (std::size_t band = 0; band < difference.size(); ++band)
    {
      excess[replicate] += check.weight[band] * difference[band];
    }
  }
  return excess;
}

}
