// SPDX-License-Identifier: BSD-3-Clause
#include "FinalGather/ReadingChecks.h"

#include "FinalGather/AreaPoints.h"
#include "Sampling/SobolPoint.h"

#include <algorithm>
#include <utility>

namespace irradiance
{

std::int64_t ReadingChecks::update(const GatherScene& scene, const FollowedPaths& paths,
  const std::vector<Start>& starts, const Kept& kept, GatherPaths& following)
{
  const ReadingChecks before = std::exchange(*this, {});
  std::vector<Points> anew;
  std::vector<std::size_t> places; // of all paths of checks
  std::size_t path = 0;
  for (const Start& start : starts)
  {
    const std::uint64_t seed = splitMix(~scene.seed ^ splitMix(start.number));
    for (std::uint32_t ray = 0; ray < scene.rays; ++ray, ++path)
    {
      if (splitMix(seed + ray) % kPeriod != 0 || keep(before, path, kept, places))
      {
        continue;
      }
      std::uint64_t hits = 0;
      PathSums::forEachHit(scene, paths[path],
        [&](const GatherSegment& segment, const PathSums::Bands& weight, const PathSums::Asked&) {
          ++hits;
          if (segment.isKnown || segment.isDirectKnown)
          {
            anew.push_back(addCheck(scene, segment, { path, ray, segment.isKnown, weight, {} },
              splitMix(seed ^ splitMix(hits << 32 | ray)), kPeriod * start.area));
            places.insert(places.end(), kPathsOfCheck, FollowedPaths::kAnew);
          }
        });
    }
  }
  FollowedPaths followed = follow(scene, anew, following);
  followed_ = kept.motion ? followed.mergedWith(before.followed_, places) : std::move(followed);
  return static_cast<std::int64_t>(following.followed().size());
}

bool ReadingChecks::keep(
  const ReadingChecks& before, std::size_t path, const Kept& kept, std::vector<std::size_t>& places)
{
  if (!kept.motion || kept.places[path] == FollowedPaths::kAnew)
  {
    return false;
  }
  const auto first = std::lower_bound(before.checks_.begin(), before.checks_.end(), path,
    [](const Check& check, std::size_t value) { return check.path < value; });
  const auto end = std::find_if(
    first, before.checks_.end(), [path](const Check& check) { return check.path != path; });
  const auto pathsBefore = [&](auto check) {
    return kPathsOfCheck * static_cast<std::size_t>(check - before.checks_.begin());
  };
  for (std::size_t i = pathsBefore(first); i < pathsBefore(end); ++i)
  {
    if (kept.motion->mayChange(before.followed_[i]))
    {
      return false;
    }
  }
  checks_.insert(checks_.end(), first, end);
  for (std::size_t i = pathsBefore(first); i < pathsBefore(end); ++i)
  {
    places.push_back(i);
  }
  return true;
}

ReadingChecks::Points ReadingChecks::addCheck(const GatherScene& scene,
  const GatherSegment& segment, Check check, std::uint64_t number, double area)
{
  const SceneTriangles& triangles = scene.space.triangles;
  const TriangleId id = triangles.idOf(segment.triangle);
  const Material& material = *scene.objects[id.object].material;
  for (int band = 0; band < scene.known.all.bands(); ++band)
  {
    check.weight[static_cast<std::size_t>(band)] *=
      area * material.reflectanceOf(id.triangle, band);
  }
  checks_.push_back(check);
  const std::size_t cell =
    scene.cells.numbers()[{ id.object, material.cellOfTriangle[id.triangle] }];
  auto [place, on] = AreaPoints(scene.shapes, triangles, cell)
                       .at(SobolPoint::inUnitSquare(check.ray, SampleKeys(splitMix(number))));
  place.turn(segment.isFront);
  return { checks_.size() - 1, number, { place.clearPosition(), place.normal, on },
    LitPoint::onTriangle(triangleOf(triangles, segment.triangle), id, segment.isFront,
      Eigen::Vector3f(segment.to.data()).cast<double>()) };
}

FollowedPaths ReadingChecks::follow(
  const GatherScene& scene, const std::vector<Points>& anew, GatherPaths& following)
{
  following.begin(scene);
  for (const Points& points : anew)
  {
    if (checks_[points.check].isKnown)
    {
      const std::vector<std::uint32_t> ray{ checks_[points.check].ray };
      following.addPoint(scene, points.anywhere, points.number, ray);
      following.addPoint(scene, points.hit, points.number, ray);
    }
  }
  following.run(scene);
  FollowedPaths followed;
  std::size_t next = 0;
  for (const Points& points : anew)
  {
    Check& check = checks_[points.check];
    check.direct = directDifference(scene, points, followed);
    followed.endPath();
    for (std::size_t i = 1; i < kPathsOfCheck; ++i)
    {
      check.isKnown ? followed.addPath(following.followed(), next++) : followed.endPath();
    }
  }
  return followed;
}

PathSums::Bands ReadingChecks::directDifference(
  const GatherScene& scene, const Points& points, FollowedPaths& rays)
{
  PathSums::Bands difference{};
  std::vector<ShadowRay> shadows;
  std::vector<ShadowRay>* const asked = scene.keepsPaths ? &shadows : nullptr;
  for (const PointDirectLight& lights : scene.lights)
  {
    const PointDirectLight::Bands anywhere =
                                    lights.irradiance(points.anywhere, points.number, asked),
                                  hit = lights.irradiance(points.hit, points.number, asked);
    for (std::size_t band = 0; band < difference.size(); ++band)
    {
      difference[band] += anywhere[band] - hit[band];
    }
  }
  for (const ShadowRay& ray : shadows)
  {
    rays.addShadow(ray);
  }
  return difference;
}

std::vector<double> ReadingChecks::excess(const GatherScene& scene) const
{
  std::vector<double> excess(scene.replicates());
  const double quantaPerWatt = scene.quantaPerWatt / scene.replicates();
  for (std::size_t i = 0; i < checks_.size(); ++i)
  {
    const Check& check = checks_[i];
    const std::uint32_t replicate = check.ray / scene.raysOfReplicate();
    const auto brought = [&](std::size_t path) {
      return PathSums::broughtBy(scene, followed_[kPathsOfCheck * i + path], replicate);
    };
    const PathSums::Bands anywhere = brought(1), hit = brought(2);
    for (std::size_t band = 0; band < check.direct.size(); ++band)
    {
      // A path brings its part of what those of the replicate bring together.
      excess[replicate] += check.weight[band] *
        (quantaPerWatt * check.direct[band] +
          scene.raysOfReplicate() * (anywhere[band] - hit[band]));
    }
  }
  return excess;
}

}
