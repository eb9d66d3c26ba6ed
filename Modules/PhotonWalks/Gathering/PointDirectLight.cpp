// SPDX-License-Identifier: BSD-3-Clause
#include "Gathering/PointDirectLight.h"

#include "Geometry/Pi.h"
#include "Meshes/SurfacePoint.h"
#include "Sampling/SobolPoint.h"
#include "Sampling/SplitMix.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace irradiance
{

PointDirectLight::PointDirectLight(const GatherSpace& space,
  std::shared_ptr<const LampPieces> lamps, std::uint64_t seed, std::uint32_t samples,
  std::size_t mostWeights)
  : space_(space)
  , lamps_(std::move(lamps))
  , seed_(seed)
  , samples_(samples)
  , mostWeights_(mostWeights)
{
}

PointDirectLight::Bands PointDirectLight::irradiance(
  const LitPoint& point, std::uint64_t number, std::vector<Shadow>* shadows) const
{
  std::vector<Bands> all(1, Bands{});
  add(point, number, all, shadows);
  return all.front();
}

void PointDirectLight::add(const LitPoint& point, std::uint64_t number,
  std::vector<Bands>& replicates, std::vector<Shadow>* shadows) const
{
  std::vector<Arrival> arrivals;
  const std::vector<std::uint32_t> touching = lightsAt(point);
  addTouching(point, touching, replicates.size(), arrivals);
  const Part cosine = [&](const Vector3& along, double) { return point.partOf(along); };
  addSamples(point, cosine, number, 0, touching, replicates.size(), arrivals);
  cast(point, arrivals, replicates, shadows);
}

PointDirectLight::Bands PointDirectLight::taken(
  const LitPoint& point, const Part& part, std::uint64_t number, std::uint32_t share) const
{
  std::vector<Arrival> arrivals;
  addSamples(point, part, number, share, lightsAt(point), 1, arrivals);
  std::vector<Bands> all(1, Bands{});
  cast(point, arrivals, all);
  return all.front();
}

double PointDirectLight::density(
  const LitPoint& point, const TriangleId& lamp, const Vector3& place) const
{
  const std::optional<std::uint32_t> light = lamps_->lightOn(lamp);
  const std::vector<std::uint32_t> touching = lightsAt(point);
  if (!light || std::find(touching.begin(), touching.end(), *light) != touching.end())
  {
    return 0;
  }
  const PointLampChoice choice(*lamps_, point, samples_, mostWeights_);
  const std::uint32_t piece = lamps_->pieceAt(*light, place);
  const double samples = samples_ * choice.probabilityOf(piece);
  return samples > 0 ? samples / choice.seen(piece).solidAngle() : 0;
}

void PointDirectLight::cast(const LitPoint& point, const std::vector<Arrival>& arrivals,
  std::vector<Bands>& replicates, std::vector<Shadow>* shadows) const
{
  std::vector<Ray> rays(arrivals.size());
  std::transform(arrivals.begin(), arrivals.end(), rays.begin(),
    [](const Arrival& arrival) { return arrival.ray; });
  std::vector<Hit> hits(rays.size());
  space_.scene.cast(rays.data(), rays.size(), hits.data());
  for (std::size_t i = 0; i < arrivals.size(); ++i)
  {
    const Shadow shadow = shadowOf(arrivals[i], point, hits[i]);
    Bands& sum = replicates[arrivals[i].replicate];
    const double perWatt = shadow.isFree ? arrivals[i].perWatt : 0;
    for (std::size_t band = 0; band < sum.size(); ++band)
    {
      sum[band] += perWatt * lamps_->lights()[arrivals[i].light].flux[band];
    }
    if (shadows)
    {
      shadows->push_back(shadow);
    }
  }
}

/// Of the table.
std::vector<std::uint32_t> PointDirectLight::lightsAt(const LitPoint& point) const
{
  std::vector<std::uint32_t> lights;
  space_.contacts.forEachLampAt(point.on, [&](const TriangleId& id) {
    if (const std::optional<std::uint32_t> light = lamps_->lightOn(id))
    {
      lights.push_back(*light);
    }
  });
  return lights;
}

/// Rays cross the gap that is not there, along the normals of the lights.
void PointDirectLight::addTouching(const LitPoint& point, const std::vector<std::uint32_t>& lights,
  std::size_t replicates, std::vector<Arrival>& arrivals) const
{
  for (const std::uint32_t light : lights)
  {
    const AreaLight& area = std::get<AreaLight>(lamps_->lights()[light].kind);
    const Vector3 weights = weightsInPlane(area.triangle, point.position);
    const SurfacePoint start = surfacePoint(area.triangle, weights.cwiseMax(0));
    const bool isOn = weights.minCoeff() >= 0 && point.normal.dot(start.normal) < 0;
    for (std::size_t replicate = 0; isOn && replicate < replicates; ++replicate)
    {
      arrivals.push_back({ { start.clearPosition(), start.normal, area.id }, light,
        1 / (area.triangle.area() * static_cast<double>(replicates)), replicate });
    }
  }
}

void PointDirectLight::addSamples(const LitPoint& point, const Part& part, std::uint64_t number,
  std::uint32_t share, const std::vector<std::uint32_t>& touching, std::size_t replicates,
  std::vector<Arrival>& arrivals) const
{
  const PointLampChoice choice(*lamps_, point, samples_, mostWeights_);
  const SampleKeys keys(splitMix(seed_ ^ splitMix(number)));
  for (std::uint32_t i = 0; i < samples_ && !choice.isEmpty(); ++i)
  {
    const std::array<double, 2> u = SobolPoint::inUnitSquare(share * samples_ + i, keys);
    const LampChoice::Choice chosen = choice.choose(u[0]);
    const LampPiece& lamp = (*lamps_)[chosen.piece];
    if (std::find(touching.begin(), touching.end(), lamp.light) == touching.end())
    {
      const double samples = chosen.probability * samples_;
      Arrival arrival =
        from(lamp, choice.seen(chosen.piece), point, part, samples, { chosen.rest, u[1] });
      arrival.perWatt /= samples;
      arrival.replicate = i * replicates / samples_;
      if (arrival.perWatt > 0)
      {
        arrivals.push_back(arrival);
      }
    }
  }
}

PointDirectLight::Arrival PointDirectLight::from(const LampPiece& lamp,
  const SphericalTriangle& seen, const LitPoint& point, const Part& part, double samples,
  const std::array<double, 2>& onLamp) const
{
  const Light& light = lamps_->lights()[lamp.light];
  if (const auto* const inAir = std::get_if<PointLight>(&light.kind))
  {
    const Vector3 along = point.position - inAir->position();
    const double taken = along.isZero(0) ? 0 : part(along, std::numeric_limits<double>::infinity());
    return { { inAir->position(), along, {} }, lamp.light,
      PointLampChoice::perWatt(*inAir, along, taken) };
  }
  const SurfacePoint start = surfacePoint(lamp.triangle, seen.sample(onLamp));
  const Vector3 between = point.position - start.position;
  // Closer to its plane, rounding would tell the side.
  const bool isInFront = start.normal.dot(between) > 4 * start.clearance;
  const double perWatt = isInFront ? part(between, samples / seen.solidAngle()) *
      seen.solidAngle() * lamp.share / (kPi * lamp.triangle.area())
                                   : 0;
  const Vector3 origin = start.clearPosition();
  return { { origin, point.position - origin, light.triangle() }, lamp.light, perWatt };
}

/// As for the samples of cells, see DirectLight.
PointDirectLight::Shadow PointDirectLight::shadowOf(
  const Arrival& arrival, const LitPoint& point, const Hit& closest) const
{
  const Contacts& contacts = space_.contacts;
  const Ray& ray = arrival.ray;
  const bool touches = contacts.has(point.on) || contacts.has(ray.start);
  const Hit hit = touches ? contacts.resolveContact(space_.scene, ray, closest) : closest;
  // Where the point's face touches others, it alone says whether the light arrives.
  const bool isFree = (hit && hit.id == point.on) || (!contacts.has(point.on) && hit.distance >= 1);
  return { ray.origin, ray.start, isFree, isFree ? TriangleId{} : hit.id };
}

}
