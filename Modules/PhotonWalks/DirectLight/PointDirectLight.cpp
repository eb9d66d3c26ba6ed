// SPDX-License-Identifier: BSD-3-Clause
#include "DirectLight/PointDirectLight.h"

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
  const LitPoint& point, std::uint64_t number, std::vector<ShadowRay>* rays) const
{
  std::vector<Bands> all(1, Bands{});
  add(point, number, all, rays);
  return all.front();
}

void PointDirectLight::add(const LitPoint& point, std::uint64_t number,
  std::vector<Bands>& replicates, std::vector<ShadowRay>* rays) const
{
  addArriving(point, arrivalsAt(point, number, replicates.size()), replicates, rays);
}

std::vector<PointDirectLight::Arrival> PointDirectLight::arrivalsAt(
  const LitPoint& point, std::uint64_t number, std::size_t replicates) const
{
  std::vector<Arrival> arrivals;
  const std::vector<std::uint32_t> touching = lightsAt(point);
  addTouching(point, touching, replicates, arrivals);
  const Part cosine = [&](const Vector3& along, double) { return point.partOf(along); };
  addSamples(point, SeenLamp::By::Cosine, cosine, number, 0, touching, replicates, arrivals);
  return arrivals;
}

std::int64_t PointDirectLight::update(const LitPoint& point, std::uint64_t number,
  const MayChange& mayChange, std::vector<ShadowRay>& rays, std::vector<Bands>& replicates) const
{
  const std::vector<Arrival> arrivals = arrivalsAt(point, number, replicates.size());
  const bool isFirst = rays.empty();
  rays.resize(arrivals.size());
  std::vector<std::size_t> changed;
  std::vector<Arrival> anew;
  for (std::size_t i = 0; i < arrivals.size(); ++i)
  {
    if (isFirst || mayChange(rays[i]))
    {
      changed.push_back(i);
      anew.push_back(arrivals[i]);
    }
  }
  const std::vector<Hit> hits = cast(point, anew);
  for (std::size_t i = 0; i < anew.size(); ++i)
  {
    rays[changed[i]] = shadowRayOf(anew[i], point, hits[i]);
  }
  for (std::size_t i = 0; i < arrivals.size(); ++i)
  {
    if (!rays[i].isStopped)
    {
      addArrival(arrivals[i], replicates);
    }
  }
  return static_cast<std::int64_t>(anew.size());
}

PointDirectLight::Bands PointDirectLight::taken(
  const LitPoint& point, const Part& part, std::uint64_t number, std::uint32_t share) const
{
  std::vector<Arrival> arrivals;
  addSamples(point, SeenLamp::By::SolidAngle, part, number, share, lightsAt(point), 1, arrivals);
  std::vector<Bands> all(1, Bands{});
  addArriving(point, arrivals, all);
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
  const PointLampChoice choice(*lamps_, point, SeenLamp::By::SolidAngle, samples_, mostWeights_);
  return samples_ * choice.densityOf(lamps_->pieceAt(*light, place));
}

void PointDirectLight::addArriving(const LitPoint& point, const std::vector<Arrival>& arrivals,
  std::vector<Bands>& replicates, std::vector<ShadowRay>* rays) const
{
  const std::vector<Hit> hits = cast(point, arrivals);
  for (std::size_t i = 0; i < arrivals.size(); ++i)
  {
    if (arrives(hits[i], point))
    {
      addArrival(arrivals[i], replicates);
    }
    if (rays)
    {
      rays->push_back(shadowRayOf(arrivals[i], point, hits[i]));
    }
  }
}

void PointDirectLight::addArrival(const Arrival& arrival, std::vector<Bands>& replicates) const
{
  Bands& sum = replicates[arrival.replicate];
  for (std::size_t band = 0; band < sum.size(); ++band)
  {
    sum[band] += arrival.perWatt * lights()[arrival.light].flux[band];
  }
}

/// As for the samples of cells, see DirectLight.
std::vector<Hit> PointDirectLight::cast(
  const LitPoint& point, const std::vector<Arrival>& arrivals) const
{
  std::vector<Ray> rays(arrivals.size());
  std::transform(arrivals.begin(), arrivals.end(), rays.begin(),
    [](const Arrival& arrival) { return arrival.ray; });
  std::vector<Hit> hits(rays.size());
  space_.scene.cast(rays.data(), rays.size(), hits.data());
  const Contacts& contacts = space_.contacts;
  for (std::size_t i = 0; !contacts.isEmpty() && i < rays.size(); ++i)
  {
    if (contacts.has(point.on) || contacts.has(rays[i].start))
    {
      hits[i] = contacts.resolveContact(space_.scene, rays[i], hits[i]);
    }
  }
  return hits;
}

/// `hit`: what it meets; on a face with contacts it has to be that face.
bool PointDirectLight::arrives(const Hit& hit, const LitPoint& point) const
{
  return (hit && hit.id == point.on) || (hit.distance >= 1 && !space_.contacts.has(point.on));
}

ShadowRay PointDirectLight::shadowRayOf(
  const Arrival& arrival, const LitPoint& point, const Hit& hit) const
{
  const bool isStopped = !arrives(hit, point);
  const Vector3& from = arrival.ray.origin;
  const Vector3 to =
    isStopped && hit ? from + hit.distance * arrival.ray.direction : point.position;
  const Contacts& contacts = space_.contacts;
  const bool touches = contacts.has(arrival.ray.start) || contacts.has(point.on);
  return { inFloats(from), inFloats(to),
    isStopped && hit ? space_.triangles.numberOf(hit.id) : ShadowRay::kNone, isStopped,
    contacts.hasDynamic(arrival.ray.start) || contacts.hasDynamic(point.on) ||
      contacts.hasDynamic(hit.id) || (touches && isStopped && hit.id.isDynamic()) };
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

/// The point touches the lights: rays have length 0, so they are given the directions of the
/// lights' normals.
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

void PointDirectLight::addSamples(const LitPoint& point, SeenLamp::By by, const Part& part,
  std::uint64_t number, std::uint32_t share, const std::vector<std::uint32_t>& touching,
  std::size_t replicates, std::vector<Arrival>& arrivals) const
{
  const PointLampChoice choice(*lamps_, point, by, samples_, mostWeights_);
  const SampleKeys keys(splitMix(seed_ ^ splitMix(number)));
  for (std::uint32_t i = 0; i < samples_ && !choice.isEmpty(); ++i)
  {
    const std::array<double, 2> u = SobolPoint::inUnitSquare(share * samples_ + i, keys);
    const PointLampChoice::Choice chosen = choice.choose(u[0]);
    const std::uint32_t light = (*lamps_)[chosen.piece].light;
    if (std::find(touching.begin(), touching.end(), light) == touching.end())
    {
      Arrival arrival = from(chosen, point, part, u[1]);
      arrival.replicate = i * replicates / samples_;
      if (arrival.perWatt > 0)
      {
        arrivals.push_back(arrival);
      }
    }
  }
}

PointDirectLight::Arrival PointDirectLight::from(const PointLampChoice::Choice& chosen,
  const LitPoint& point, const Part& part, double onLamp) const
{
  const LampPiece& lamp = (*lamps_)[chosen.piece];
  const Light& light = lamps_->lights()[lamp.light];
  const double samples = chosen.probability * samples_;
  if (const auto* const inAir = std::get_if<PointLight>(&light.kind))
  {
    const Vector3 along = point.position - inAir->position();
    const double taken = along.isZero(0) ? 0 : part(along, std::numeric_limits<double>::infinity());
    return { { inAir->position(), along, {} }, lamp.light,
      PointLampChoice::perWatt(*inAir, along, taken) / samples };
  }
  if (!chosen.seen)
  {
    return { {}, lamp.light, 0 };
  }
  const SeenLamp::Sample sample = chosen.seen->sample({ chosen.rest, onLamp });
  const SurfacePoint start = surfacePoint(lamp.triangle, sample.weights);
  const Vector3 between = point.position - start.position;
  // Closer to its plane, rounding would tell the side.
  const bool isInFront = start.normal.dot(between) > 4 * start.clearance;
  const double perWatt = isInFront ? part(between, samples / sample.solidAngle) *
      sample.solidAngle * lamp.share / (kPi * lamp.triangle.area())
                                   : 0;
  const Vector3 origin = start.clearPosition();
  return { { origin, point.position - origin, light.triangle() }, lamp.light, perWatt / samples };
}

}
