// SPDX-License-Identifier: BSD-3-Clause
#include "OutgoingRadiance.h"

#include "Execution/SlicedPass.h"
#include "Meshes/SurfacePoint.h"
#include "Sampling/DirectionSampling.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace irradiance
{

namespace
{

constexpr double kPi = 3.14159265358979323846;

void add(OutgoingRadiance::Bands& sum, const OutgoingRadiance::Bands& part, double factor = 1)
{
  for (std::size_t band = 0; band < sum.size(); ++band)
  {
    sum[band] += factor * part[band];
  }
}

}

OutgoingRadiance::OutgoingRadiance(
  IrradianceEngine& engine, std::uint32_t mirrorSamples, Execution& execution)
  : engine_(engine)
  , mirrorPoints_(0)
  , mirrorSamples_(mirrorSamples)
  , bands_(engine.objects().staticObject.material->bands)
{
  for (std::uint32_t object = 0; object < engine.objects().size(); ++object)
  {
    addCells(object, execution);
  }
  collectArrivals(execution);
}

void OutgoingRadiance::addCells(std::uint32_t object, Execution& execution)
{
  const std::vector<std::uint32_t>& cellOf = materialOf(object).cellOfTriangle;
  Cells cells;
  cells.triangles.resize(cellOf.size());
  std::iota(cells.triangles.begin(), cells.triangles.end(), 0u);
  std::stable_sort(cells.triangles.begin(), cells.triangles.end(),
    [&](std::uint32_t a, std::uint32_t b) { return cellOf[a] < cellOf[b]; });
  cells.first.assign(materialOf(object).numberOfCells + 1, 0);
  for (const std::uint32_t cell : cellOf)
  {
    ++cells.first[cell + 1];
  }
  std::partial_sum(cells.first.begin(), cells.first.end(), cells.first.begin());
  cells.areas = cellAreas(engine_.objects()[object], checkpointOf(execution, 0));
  cells.firstCell = objects_.empty() ? 0 : objects_.back().firstCell + objects_.back().areas.size();
  objects_.push_back(std::move(cells));
}

void OutgoingRadiance::collectArrivals(Execution& execution)
{
  const SpecularPhotons& photons = engine_.specularPhotons(execution);
  if (photons.isEmpty())
  {
    return;
  }
  arrivals_.resize(objects_.back().firstCell + objects_.back().areas.size());
  const SobolSequence samples = engine_.samples();
  const WalkShooter shooter = engine_.shooter(samples);
  const WalkHistory history = engine_.photons();
  for (std::uint32_t object = 0; object < objects_.size(); ++object)
  {
    const Material& material = materialOf(object);
    SlicedPass pass{ material.isSpecular() ? material.numberOfCells : 0, {} };
    pass.work = [&](std::size_t cell, const Deadline&) {
      if (!material.isSpecular(cell) || material.lobeOf(cell).isMirror())
      {
        return true;
      }
      std::vector<WalkShooter::Stored> segments;
      for (const PhotonReference& photon : photons.sorted(object, cell))
      {
        std::uint32_t walkInBlock = 0;
        const WalkBlock& block = history.blockOf(photon, walkInBlock);
        segments.push_back({ &block, walkInBlock, photon.walk, photon.bounce });
      }
      std::vector<SurfacePoint> points(segments.size());
      std::vector<Vector3> directions(segments.size());
      shooter.arrivalsOf(segments.data(), segments.size(), points.data(), directions.data());
      std::vector<Arrival>& arrivals = arrivals_[objects_[object].firstCell + cell];
      for (std::size_t i = 0; i < segments.size(); ++i)
      {
        arrivals.push_back({ points[i].position, -directions[i], points[i].normal,
          segments[i].block->power(segments[i].walkInBlock, segments[i].bounce) });
      }
      return true;
    };
    pass.run(execution);
  }
}

OutgoingRadiance::Bands OutgoingRadiance::operator()(
  std::uint32_t object, std::size_t cell, const Eye& eye) const
{
  Bands radiance{};
  if (objects_[object].areas[cell] > 0)
  {
    add(radiance, diffuse(object, cell, eye));
    if (isSpecular(object, cell))
    {
      const bool isMirror = materialOf(object).lobeOf(cell).isMirror();
      add(radiance, isMirror ? mirrored(object, cell, eye) : specular(object, cell, eye));
    }
  }
  return radiance;
}

/// Each triangle of the cell shows the eye one of its sides.
OutgoingRadiance::Bands OutgoingRadiance::diffuse(
  std::uint32_t object, std::size_t cell, const Eye& eye) const
{
  const Cells& cells = objects_[object];
  double front = 0, back = 0; // parts of the area
  for (std::size_t i = cells.first[cell]; i < cells.first[cell + 1]; ++i)
  {
    const Triangle triangle = engine_.scene().worldTriangle({ object, cells.triangles[i] });
    const Vector3 toEye = eye.directionFrom((triangle.a + triangle.b + triangle.c) / 3);
    (toEye.dot(triangle.areaVector()) >= 0 ? front : back) += triangle.area();
  }
  Bands radiance{};
  for (const bool isFront : { true, false })
  {
    if ((isFront ? front : back) > 0)
    {
      add(radiance, diffuseOf(object, cell, isFront), (isFront ? front : back) / (front + back));
    }
  }
  return radiance;
}

OutgoingRadiance::Bands OutgoingRadiance::diffuseOf(
  std::uint32_t object, std::size_t cell, bool isFront) const
{
  const Material& material = materialOf(object);
  const int side = isFront || !engine_.settings().separateSides ? 0 : 1;
  Bands radiance{};
  for (int band = 0; band < bands_; ++band)
  {
    const auto i = static_cast<std::size_t>(band);
    const std::size_t slot = cell * static_cast<std::size_t>(bands_) + i;
    const double emitted = isFront && !material.exitance.empty() ? material.exitance[slot] : 0;
    radiance[i] = (emitted +
                    material.reflectance[slot] *
                      engine_.irradiance(object, cell, side, band, objects_[object].areas[cell])) /
      kPi;
  }
  return radiance;
}

OutgoingRadiance::Bands OutgoingRadiance::specular(
  std::uint32_t object, std::size_t cell, const Eye& eye) const
{
  const Material& material = materialOf(object);
  const PhongLobe& lobe = material.lobeOf(cell);
  Bands sum{}; // W/sr
  for (const Arrival& photon : arrivals_[objects_[object].firstCell + cell])
  {
    const double value = lobe.value(photon.normal, photon.toLight, eye.directionFrom(photon.point));
    for (int band = 0; band < bands_; ++band)
    {
      sum[static_cast<std::size_t>(band)] += value * engine_.watts(photon.power[band]);
    }
  }
  const std::size_t first = cell * static_cast<std::size_t>(bands_);
  for (std::size_t band = 0; band < static_cast<std::size_t>(bands_); ++band)
  {
    sum[band] *= material.specularReflectance[first + band] / objects_[object].areas[cell];
  }
  return sum;
}

Ray OutgoingRadiance::mirrorRay(
  std::uint32_t object, std::size_t cell, std::uint32_t sample, const Eye& eye) const
{
  const Cells& cells = objects_[object];
  double rest = (sample + 0.5) / mirrorSamples_ * cells.areas[cell];
  std::size_t i = cells.first[cell];
  const auto triangleAt = [&](std::size_t place) {
    return engine_.scene().worldTriangle({ object, cells.triangles[place] });
  };
  double area = triangleAt(i).area();
  while (rest > area && i + 1 < cells.first[cell + 1])
  {
    rest -= area;
    area = triangleAt(++i).area();
  }
  SurfacePoint point = surfacePoint(
    triangleAt(i), sampleTriangle(mirrorPoints_.sample(sample, 0, SampleUse::Position)));
  const Vector3 toEye = eye.directionFrom(point.position);
  point.turn(toEye.dot(point.normal) >= 0);
  return { point.clearPosition(), irradiance::mirrored(point.normal, -toEye),
    { object, cells.triangles[i] } };
}

OutgoingRadiance::Bands OutgoingRadiance::mirrored(
  std::uint32_t object, std::size_t cell, const Eye& eye) const
{
  Bands sum{};
  for (std::uint32_t sample = 0; sample < mirrorSamples_; ++sample)
  {
    const Ray ray = mirrorRay(object, cell, sample, eye);
    if (!ray.direction.isZero(0)) // the eye is not at the very point
    {
      add(sum, alongRay(ray), 1.0 / mirrorSamples_);
    }
  }
  const std::size_t first = cell * static_cast<std::size_t>(bands_);
  for (std::size_t band = 0; band < static_cast<std::size_t>(bands_); ++band)
  {
    sum[band] *= materialOf(object).specularReflectance[first + band];
  }
  return sum;
}

OutgoingRadiance::Bands OutgoingRadiance::alongRay(Ray ray) const
{
  Bands sum{}, seen{ 1, 1, 1 }; // the part of what leaves a hit that gets through the mirrors
  for (int mirrors = 0; mirrors <= kMostMirrors; ++mirrors)
  {
    const Hit hit = engine_.scene().cast(ray);
    if (!hit)
    {
      break;
    }
    const std::uint32_t object = hit.id.object;
    const Material& material = materialOf(object);
    const std::size_t cell = material.cellOfTriangle[hit.id.triangle];
    const SurfacePoint point = engine_.scene().surfaceAt(ray.direction, hit);
    Bands radiance = diffuseOf(object, cell, point.isFront);
    const bool isMirror = isSpecular(object, cell) && material.lobeOf(cell).isMirror();
    if (isSpecular(object, cell) && !isMirror)
    {
      add(radiance, specular(object, cell, { -ray.direction, true }));
    }
    for (std::size_t band = 0; band < static_cast<std::size_t>(bands_); ++band)
    {
      sum[band] += seen[band] * radiance[band];
      seen[band] *=
        isMirror ? material.specularReflectance[cell * static_cast<std::size_t>(bands_) + band] : 0;
    }
    if (!isMirror)
    {
      break;
    }
    ray = { point.clearPosition(), irradiance::mirrored(point.normal, ray.direction), hit.id };
  }
  return sum;
}

}
