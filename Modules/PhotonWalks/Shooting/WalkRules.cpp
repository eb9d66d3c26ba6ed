// SPDX-License-Identifier: BSD-3-Clause
#include "Shooting/WalkRules.h"

#include "Shooting/Stages.h"
#include "Simd/Prefetch.h"

#include <algorithm>

namespace irradiance
{

WalkRules::WalkRules(
  const SceneObjects& objects, const EmitterTable& emitters, const SobolSequence& samples)
  : emitters_(emitters)
  , samples_(samples)
  , bands_(objects.staticObject.material->bands)
{
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    const SceneObject& object = objects[i];
    surfaces_.push_back({ object.body->mesh().triangles().data(), &object.worldFromObject,
      object.material.get(), object.material->cellOfTriangle.data(),
      object.material->totalReflectance().data(), object.material->isSpecular() });
  }
}

std::size_t WalkRules::emitterOf(std::uint32_t walk) const
{
  return emitters_.choose(samples_.sample(walk, 0, SampleUse::Emitter)[0]);
}

void WalkRules::start(const std::uint32_t* walks, std::size_t count, Ray* rays) const
{
  Departures departures(*this);
  SampleLanes chosen, positions;
  for (std::size_t first = 0; first < count; first += SampleLanes::kSize)
  {
    const auto lanes =
      static_cast<unsigned>(std::min<std::size_t>(count - first, SampleLanes::kSize));
    for (unsigned lane = 0; lane < lanes; ++lane)
    {
      chosen.set(lane, samples_, walks[first + lane], 0, SampleUse::Emitter);
      positions.set(lane, samples_, walks[first + lane], 0, SampleUse::Position);
    }
    drawAllFirst(chosen);
    drawAll(positions);
    for (unsigned lane = 0; lane < lanes; ++lane)
    {
      const std::uint32_t walk = walks[first + lane];
      const std::size_t number = emitters_.choose(chosen.x[lane]);
      const Emitter& emitter = emitters_.emitters()[number];
      if (emitter.isPoint())
      {
        rays[first + lane] =
          emitters_.pointRay(number, samples_.sample(walk, 0, SampleUse::Direction));
        continue;
      }
      departures.add(
        { walk, 0, emitter.id, sampleTriangle({ positions.x[lane], positions.y[lane] }), 1, {} },
        rays + first + lane);
    }
  }
  departures.flush();
}

void WalkRules::survive(const std::uint32_t* walks, const std::uint32_t* bounces,
  const double* probabilities, std::size_t count, std::uint32_t first,
  std::vector<std::uint32_t>& survivors) const
{
  SampleLanes samples;
  std::size_t kept = survivors.size();
  survivors.resize(kept + count);
  for (std::size_t begin = 0; begin < count; begin += SampleLanes::kSize)
  {
    const auto lanes =
      static_cast<unsigned>(std::min<std::size_t>(count - begin, SampleLanes::kSize));
    for (unsigned lane = 0; lane < lanes; ++lane)
    {
      samples.set(
        lane, samples_, walks[begin + lane], bounces[begin + lane] + 1, SampleUse::Survival);
    }
    drawAllFirst(samples);
    for (unsigned lane = 0; lane < lanes; ++lane)
    {
      survivors[kept] = first + static_cast<std::uint32_t>(begin) + lane;
      kept += samples.x[lane] < probabilities[begin + lane] ? 1 : 0;
    }
  }
  survivors.resize(kept);
}

void WalkRules::prefetchTriangle(const Hit& hit) const
{
  if (hit)
  {
    const Surface& surface = surfaces_[hit.id.object];
    const auto* triangle = reinterpret_cast<const char*>(surface.triangles + hit.id.triangle);
    prefetchLine(triangle);
    prefetchLine(triangle + sizeof(Triangle) - 1);
    prefetchLine(surface.cellOfTriangle + hit.id.triangle);
  }
}

void WalkRules::prefetchCell(const Hit& hit) const
{
  if (hit)
  {
    const Surface& surface = surfaces_[hit.id.object];
    prefetchLine((bands_ == 1 ? surface.totalReflectance : surface.material->reflectance.data()) +
      std::size_t{ cellOf(hit.id) } * static_cast<std::size_t>(bands_));
  }
}

Reflection WalkRules::chosenReflection(
  const TriangleId& hit, std::uint32_t walk, std::uint32_t bounce, const Power& incoming) const
{
  const SurvivalProbabilities probabilities =
    survivalProbabilities(incoming, materialOf(hit.object), cellOf(hit));
  // Most cells of a shiny thing may be matte: what survives there needs no sample.
  return probabilities.specular == 0
    ? Reflection::Diffuse
    : probabilities.chosenBy(samples_.sample(walk, bounce, SampleUse::Survival)[0]);
}

void Departures::add(const Departure& departure, Ray* ray, bool* isFront)
{
  if (departure.reflection == Reflection::Diffuse)
  {
    addDiffuse(departure, ray, isFront);
    return;
  }
  const bool leavesFront = leaveSpecularly(departure, *ray);
  if (isFront)
  {
    *isFront = leavesFront;
  }
}

bool Departures::leaveSpecularly(const Departure& departure, Ray& ray) const
{
  const TriangleId id = departure.id;
  SurfacePoint point = surfacePoint(rules_.triangleOf(id), departure.weights);
  point.turn(departure.side == 0 ? departure.incoming.dot(point.normal) <= 0 : departure.side > 0);
  const Vector3 incoming = incomingDirection(point, departure.from);
  const auto sample = [&](SampleUse use) {
    return rules_.samples_.sample(departure.walk, departure.bounce, use);
  };
  const LobeSample samples{ sample(SampleUse::Direction), sample(SampleUse::Acceptance)[0],
    sample(SampleUse::Compensation) };
  const PhongLobe& lobe = rules_.materialOf(id.object).lobeOf(rules_.cellOf(id));
  ray = { point.clearPosition(), lobe.sample(point.normal, incoming, samples), id };
  return point.isFront;
}

void Departures::addDiffuse(const Departure& departure, Ray* ray, bool* isFront)
{
  lanes_.setTriangle(count_, rules_.triangleOf(departure.id));
  lanes_.weights.set(count_, departure.weights);
  lanes_.incoming.set(count_, departure.incoming);
  lanes_.side[count_] = departure.side;
  lanes_.samples.set(
    count_, rules_.samples_, departure.walk, departure.bounce, SampleUse::Direction);
  ids_[count_] = departure.id;
  rays_[count_] = ray;
  isFront_[count_] = isFront;
  if (++count_ == LeavingLanes::kSize)
  {
    flush();
  }
}

void Departures::flush()
{
  if (count_ == 0)
  {
    return;
  }
  leaveAll(lanes_);
  for (unsigned lane = 0; lane < count_; ++lane)
  {
    *rays_[lane] = { lanes_.origin.get(lane), lanes_.direction.get(lane), ids_[lane] };
    if (isFront_[lane])
    {
      *isFront_[lane] = lanes_.side[lane] > 0;
    }
  }
  count_ = 0;
}

}
