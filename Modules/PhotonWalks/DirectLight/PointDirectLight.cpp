// SPDX-License-Identifier: BSD-3-Clause
#include "DirectLight/PointDirectLight.h"

#include "Sampling/SobolPoint.h"
#include "Sampling/SplitMix.h"

#include <algorithm>
#include <utility>

namespace irradiance
{

PointDirectLight::PointDirectLight(const Frame& frame, std::shared_ptr<const LampPieces> lamps,
  std::uint64_t seed, std::uint32_t samples, std::size_t mostWeights)
  : frame_(frame)
  , lamps_(std::move(lamps))
  , seed_(seed)
  , samples_(samples)
  , mostWeights_(mostWeights)
{
}

Bands PointDirectLight::irradiance(
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
  addSamples(point, SeenLight::By::Cosine, cosine, number, 0, touching, replicates, arrivals);
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

Bands PointDirectLight::taken(
  const LitPoint& point, const Part& part, std::uint64_t number, std::uint32_t share) const
{
  std::vector<Arrival> arrivals;
  addSamples(point, SeenLight::By::SolidAngle, part, number, share, lightsAt(point), 1, arrivals);
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
  const PointLampChoice choice(*lamps_, point, SeenLight::By::SolidAngle, samples_, mostWeights_);
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
  replicates[arrival.replicate] += arrival.perWatt * lights()[arrival.light].flux;
}

/// As for the samples of cells, see DirectLight.
std::vector<Hit> PointDirectLight::cast(
  const LitPoint& point, const std::vector<Arrival>& arrivals) const
{
  std::vector<Ray> rays(arrivals.size());
  std::transform(arrivals.begin(), arrivals.end(), rays.begin(),
    [](const Arrival& arrival) { return arrival.ray; });
  std::vector<Hit> hits(rays.size());
  frame_.scene.cast(rays.data(), rays.size(), hits.data());
  const Contacts& contacts = frame_.contacts;
  for (std::size_t i = 0; !contacts.isEmpty() && i < rays.size(); ++i)
  {
    if (contacts.has(point.on) || contacts.has(rays[i].start))
    {
      hits[i] = contacts.resolveContact(frame_.scene, rays[i], hits[i]);
    }
  }
  return hits;
}

/// `hit`: what it meets; on a face with contacts it has to be that face.
bool PointDirectLight::arrives(const Hit& hit, const LitPoint& point) const
{
  return (hit && hit.id == point.on) || (hit.distance >= 1 && !frame_.contacts.has(point.on));
}

ShadowRay PointDirectLight::shadowRayOf(
  const Arrival& arrival, const LitPoint& point, const Hit& hit) const
{
  const bool isStopped = !arrives(hit, point);
  const Vector3& from = arrival.ray.origin;
  const Vector3 to =
    isStopped && hit ? from + hit.distance * arrival.ray.direction : point.position;
  const Contacts& contacts = frame_.contacts;
  const bool touches = contacts.has(arrival.ray.start) || contacts.has(point.on);
  return { inFloats(from), inFloats(to),
    isStopped && hit ? frame_.triangles.numberOf(hit.id) : ShadowRay::kNone, isStopped,
    contacts.hasDynamic(arrival.ray.start) || contacts.hasDynamic(point.on) ||
      contacts.hasDynamic(hit.id) || (touches && isStopped && hit.id.isDynamic()) };
}

/// The point touches the lights: rays have length 0, so they are given the directions of the
/// lights' normals.
void PointDirectLight::addTouching(const LitPoint& point,
  const std::vector<std::uint32_t>& touching, std::size_t replicates,
  std::vector<Arrival>& arrivals) const
{
  for (const std::uint32_t light : touching)
  {
    const Triangle& surface = *lights()[light].surface();
    const Vector3 weights = weightsInPlane(surface, point.position);
    const SurfacePoint start = surfacePoint(surface, weights.cwiseMax(0));
    const bool isOn = weights.minCoeff() >= 0 && point.normal.dot(start.normal) < 0;
    for (std::size_t replicate = 0; isOn && replicate < replicates; ++replicate)
    {
      arrivals.push_back({ { start.clearPosition(), start.normal, lights()[light].triangle() },
        light, 1 / (surface.area() * static_cast<double>(replicates)), replicate });
    }
  }
}

void PointDirectLight::addSamples(const LitPoint& point, SeenLight::By by, const Part& part,
  std::uint64_t number, std::uint32_t share, const std::vector<std::uint32_t>& touching,
  std::size_t replicates, std::vector<Arrival>& arrivals) const
{
  const PointLampChoice choice(*lamps_, point, by, samples_, mostWeights_);
  const SampleKeys keys(splitMix(seed_ ^ splitMix(number)));
  for (std::uint32_t i = 0; i < samples_ && !choice.isEmpty(); ++i)
  {
    const std::array<double, 2> u = SobolPoint::inUnitSquare(share * samples_ + i, keys);
    const PointLampChoice::Choice chosen = choice.choose(u[0]);
    if (std::find(touching.begin(), touching.end(), chosen.light) == touching.end())
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
  if (!chosen.seen)
  {
    return { {}, chosen.light, 0 };
  }
  const double samples = chosen.probability * samples_;
  const SeenLight::Sample seen = chosen.seen->sample({ chosen.rest, onLamp }, point);
  const double perWatt =
    seen.isLit() ? seen.perWatt(part(seen.along, samples / seen.solidAngle)) : 0;
  return { seen.ray, chosen.light, perWatt / samples };
}

}
