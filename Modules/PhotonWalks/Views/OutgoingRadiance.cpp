// SPDX-License-Identifier: BSD-3-Clause
#include "Views/OutgoingRadiance.h"

#include "Execution/SlicedPass.h"
#include "Geometry/Pi.h"
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

void add(OutgoingRadiance::Bands& sum, const OutgoingRadiance::Bands& part, double factor = 1)
{
  for (std::size_t band = 0; band < sum.size(); ++band)
  {
    sum[band] += factor * part[band];
  }
}

}

OutgoingRadiance::OutgoingRadiance(
  const IrradianceEngine& engine, std::uint32_t mirrorSamples, Execution& execution)
  : engine_(engine)
  , mirrorPoints_(0)
  , mirrorSamples_(mirrorSamples)
  , bands_(engine.objects().staticObject.material->bands)
{
  for (std::uint32_t object = 0; object < engine.objects().size(); ++object)
  {
    addCells(object);
  }
  preparePhotons(execution);
}

void OutgoingRadiance::addCells(std::uint32_t object)
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
  objects_.push_back(std::move(cells));
}

void OutgoingRadiance::preparePhotons(Execution& execution)
{
  const CellPhotonSets& photons = engine_.photons<CellPhotonSets>();
  if (photons.isEmpty())
  {
    return;
  }
  photons_.resize(engine_.cells().numbers().size());
  const StoredWalks walks(engine_.walks(), engine_.space());
  for (std::uint32_t object = 0; object < objects_.size(); ++object)
  {
    const Material& material = materialOf(object);
    SlicedPass pass{ material.isSpecular() ? material.numberOfCells : 0, {} };
    pass.work = [&](std::size_t cell, const Deadline&) {
      if (!material.isSpecular(cell) || material.lobeOf(cell).isMirror())
      {
        return true;
      }
      photons_[numberOf({ object, cell })] =
        GlossyPhotons(material.lobeOf(cell), arrivalsOn({ object, cell }, walks), bands_);
      return true;
    };
    pass.run(execution);
  }
}

std::vector<GlossyPhotons::Arrival> OutgoingRadiance::arrivalsOn(
  const SceneCell& cell, const StoredWalks& walks) const
{
  const std::vector<SegmentRef> segments = engine_.photons<CellPhotonSets>().sorted(cell);
  std::vector<SurfacePoint> points(segments.size());
  std::vector<Vector3> directions(segments.size());
  walks.arrivalsOf(segments, points.data(), directions.data());
  std::vector<GlossyPhotons::Arrival> arrivals;
  for (std::size_t i = 0; i < segments.size(); ++i)
  {
    const WalkHistory& history = walks.historyOf(segments[i].walk);
    arrivals.push_back({ history.hit(segments[i]).id.triangle, points[i], -directions[i],
      wattsOf(history.power(segments[i])) });
  }
  for (const WalkSet& set : engine_.walks().sets())
  {
    set.forEachGathered([&](const GatheredLight& light) { addGathered(cell, light, arrivals); });
  }
  return arrivals;
}

void OutgoingRadiance::addGathered(const SceneCell& cell, const GatheredLight& light,
  std::vector<GlossyPhotons::Arrival>& arrivals) const
{
  const DirectLight& direct = light.light();
  const std::size_t number = numberOf(cell);
  const bool isKnown = number < direct.plan().numberOfCells(); // else it came later
  const std::uint32_t count = isKnown ? direct.plan().samplesOf(number) : 0;
  for (std::uint32_t i = 0; i < count; ++i)
  {
    const std::uint32_t place = direct.plan().first(number) + i;
    const GatherSample& sample = direct.samples()[place];
    if (direct.isVisible(place))
    {
      const TriangleId id = engine_.gatherSpace().triangles.idOf(sample.triangle);
      const double b = sample.weightB, c = sample.weightC;
      SurfacePoint point = surfacePoint(engine_.scene().worldTriangle(id), { 1 - b - c, b, c });
      point.turn(sample.isFront);
      arrivals.push_back({ id.triangle, point, -incomingDirection(point, sample.from),
        wattsOf(direct.powerOf(sample, light.quantaPerWatt())) });
    }
  }
}

OutgoingRadiance::Bands OutgoingRadiance::operator()(const SceneCell& cell, const Eye& eye) const
{
  Bands radiance{};
  if (engine_.cells().area(cell) > 0)
  {
    add(radiance, diffuse(cell, eye));
    if (isSpecular(cell))
    {
      add(radiance, lobeOf(cell).isMirror() ? mirrored(cell, eye) : specular(cell, eye));
    }
  }
  return radiance;
}

/// Each triangle of the cell shows the eye one of its sides.
OutgoingRadiance::Bands OutgoingRadiance::diffuse(const SceneCell& cell, const Eye& eye) const
{
  const Cells& cells = objects_[cell.object];
  double front = 0, back = 0; // parts of the area
  for (std::size_t i = cells.first[cell.cell]; i < cells.first[cell.cell + 1]; ++i)
  {
    const Triangle triangle = engine_.scene().worldTriangle({ cell.object, cells.triangles[i] });
    const Vector3 toEye = eye.directionFrom((triangle.a + triangle.b + triangle.c) / 3);
    (toEye.dot(triangle.areaVector()) >= 0 ? front : back) += triangle.area();
  }
  Bands radiance{};
  for (const bool isFront : { true, false })
  {
    if ((isFront ? front : back) > 0)
    {
      add(radiance, diffuseOf(cell, isFront), (isFront ? front : back) / (front + back));
    }
  }
  return radiance;
}

OutgoingRadiance::Bands OutgoingRadiance::diffuseOf(const SceneCell& cell, bool isFront) const
{
  const Material& material = materialOf(cell.object);
  const double* const exitance =
    isFront ? engine_.objects()[cell.object].exitanceOf(cell.cell) : nullptr;
  const int side = isFront || !engine_.settings().separateSides ? 0 : 1;
  Bands radiance{};
  for (int band = 0; band < bands_; ++band)
  {
    const auto i = static_cast<std::size_t>(band);
    const std::size_t slot = cell.cell * static_cast<std::size_t>(bands_) + i;
    radiance[i] = ((exitance ? exitance[i] : 0) +
                    material.reflectance[slot] * engine_.irradiance({ cell, side }, band)) /
      kPi;
  }
  return radiance;
}

OutgoingRadiance::Bands OutgoingRadiance::specular(const SceneCell& cell, const Eye& eye) const
{
  const Material& material = materialOf(cell.object);
  Bands sum = photons_[numberOf(cell)].towards(eye, lobeOf(cell));
  const std::size_t first = cell.cell * static_cast<std::size_t>(bands_);
  for (std::size_t band = 0; band < static_cast<std::size_t>(bands_); ++band)
  {
    sum[band] *= material.specularReflectance[first + band] / engine_.cells().area(cell);
  }
  return sum;
}

Ray OutgoingRadiance::mirrorRay(const SceneCell& cell, std::uint32_t sample, const Eye& eye) const
{
  const Cells& cells = objects_[cell.object];
  double rest = (sample + 0.5) / mirrorSamples_ * engine_.cells().area(cell);
  std::size_t i = cells.first[cell.cell];
  const auto triangleAt = [&](std::size_t place) {
    return engine_.scene().worldTriangle({ cell.object, cells.triangles[place] });
  };
  double area = triangleAt(i).area();
  while (rest > area && i + 1 < cells.first[cell.cell + 1])
  {
    rest -= area;
    area = triangleAt(++i).area();
  }
  SurfacePoint point = surfacePoint(
    triangleAt(i), sampleTriangle(mirrorPoints_.sample(sample, 0, SampleUse::Position)));
  const Vector3 toEye = eye.directionFrom(point.position);
  point.turn(toEye.dot(point.normal) >= 0);
  return { point.clearPosition(), irradiance::mirrored(point.normal, -toEye),
    { cell.object, cells.triangles[i] } };
}

OutgoingRadiance::Bands OutgoingRadiance::mirrored(const SceneCell& cell, const Eye& eye) const
{
  Bands sum{};
  Sights sights;
  for (std::uint32_t sample = 0; sample < mirrorSamples_; ++sample)
  {
    const Ray ray = mirrorRay(cell, sample, eye);
    if (!ray.direction.isZero(0)) // the eye is not at the very point
    {
      sights.rays.push_back(ray);
    }
  }
  const double share = 1.0 / mirrorSamples_;
  sights.shares.assign(sights.rays.size(), { share, share, share });
  for (int mirrors = 0; mirrors <= kMostMirrors && !sights.rays.empty(); ++mirrors)
  {
    look(sights, sum);
  }
  const std::size_t first = cell.cell * static_cast<std::size_t>(bands_);
  for (std::size_t band = 0; band < static_cast<std::size_t>(bands_); ++band)
  {
    sum[band] *= materialOf(cell.object).specularReflectance[first + band];
  }
  return sum;
}

/// Cell by cell, as all rays to a cell read the same photons.
void OutgoingRadiance::look(Sights& sights, Bands& sum) const
{
  std::vector<Hit> hits(sights.rays.size());
  engine_.scene().cast(sights.rays.data(), sights.rays.size(), hits.data());
  const auto cellOf = [&](std::size_t ray) { return engine_.sums().cellOf(hits[ray].id); };
  std::vector<std::pair<std::size_t, std::size_t>> order; // number of the cell, ray
  for (std::size_t i = 0; i < hits.size(); ++i)
  {
    if (hits[i])
    {
      order.emplace_back(numberOf(cellOf(i)), i);
    }
  }
  std::sort(order.begin(), order.end());
  Sights next;
  for (const auto& [number, i] : order)
  {
    const SceneCell cell = cellOf(i);
    const Ray& ray = sights.rays[i];
    const SurfacePoint point = engine_.scene().surfaceAt(ray.direction, hits[i]);
    Bands radiance = diffuseOf(cell, point.isFront), reflected = sights.shares[i];
    const bool isMirror = isSpecular(cell) && lobeOf(cell).isMirror();
    if (isSpecular(cell) && !isMirror)
    {
      add(radiance, specular(cell, { -ray.direction, true }));
    }
    for (std::size_t band = 0; band < static_cast<std::size_t>(bands_); ++band)
    {
      sum[band] += sights.shares[i][band] * radiance[band];
      reflected[band] *= isMirror
        ? materialOf(cell.object)
            .specularReflectance[cell.cell * static_cast<std::size_t>(bands_) + band]
        : 0;
    }
    if (isMirror)
    {
      next.rays.push_back(
        { point.clearPosition(), irradiance::mirrored(point.normal, ray.direction), hits[i].id });
      next.shares.push_back(reflected);
    }
  }
  sights = std::move(next);
}

}
