// SPDX-License-Identifier: BSD-3-Clause
#include "Shooting/WalkSampler.h"

#include "Shooting/Stages.h"
#include "Simd/Prefetch.h"

#include <algorithm>

namespace irradiance
{

WalkSampler::WalkSampler(
  const SceneObjects& objects, const LightTable& lights, const SobolSequence& samples)
  : lights_(lights)
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

std::size_t WalkSampler::numberOfLight(std::uint32_t walk) const
{
  return lights_.choose(samples_.sample(walk, 0, SampleUse::Light)[0]);
}

void WalkSampler::start(const std::uint32_t* walks, std::size_t count, Ray* rays) const
{
  ScatteredRays scattered(*this);
  SampleLanes chosen, positions;
  for (std::size_t first = 0; first < count; first += SampleLanes::kSize)
  {
    const auto lanes =
      static_cast<unsigned>(std::min<std::size_t>(count - first, SampleLanes::kSize));
    for (unsigned lane = 0; lane < lanes; ++lane)
    {
      chosen.set(lane, samples_, walks[first + lane], 0, SampleUse::Light);
      positions.set(lane, samples_, walks[first + lane], 0, SampleUse::Position);
    }
    drawAllFirst(chosen);
    drawAll(positions);
    for (unsigned lane = 0; lane < lanes; ++lane)
    {
      const std::uint32_t walk = walks[first + lane];
      const Light& light = lights_[lights_.choose(chosen.x[lane])];
      const TriangleId triangle = light.triangle();
      if (triangle == TriangleId{})
      {
        rays[first + lane] = light.leaving(samples_.sample(walk, 0, SampleUse::Direction));
        continue;
      }
      scattered.add(
        { walk, 0, triangle, sampleTriangle({ positions.x[lane], positions.y[lane] }), 1, {} },
        rays + first + lane);
    }
  }
  scattered.flush();
}

void WalkSampler::survive(const std::uint32_t* walks, const std::uint32_t* bounces,
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

void WalkSampler::prefetchTriangle(const Hit& hit) const
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

void WalkSampler::prefetchCell(const Hit& hit) const
{
  if (hit)
  {
    const Surface& surface = surfaces_[hit.id.object];
    prefetchLine((bands_ == 1 ? surface.totalReflectance : surface.material->reflectance.data()) +
      std::size_t{ cellOf(hit.id) } * static_cast<std::size_t>(bands_));
  }
}

Reflection WalkSampler::chosenReflection(
  const TriangleId& hit, std::uint32_t walk, std::uint32_t bounce, const Power& incoming) const
{
  const SurvivalProbabilities probabilities =
    survivalProbabilities(incoming, materialOf(hit.object), cellOf(hit));
  // Most cells of a shiny object may be matte: what survives there needs no sample.
  return probabilities.specular == 0
    ? Reflection::Diffuse
    : probabilities.chosenBy(samples_.sample(walk, bounce, SampleUse::Survival)[0]);
}

void ScatteredRays::add(const ScatteredRay& leaving, Ray* ray, bool* isFront)
{
  if (leaving.reflection == Reflection::Diffuse)
  {
    addDiffuse(leaving, ray, isFront);
    return;
  }
  const bool leavesFront = scatterSpecularly(leaving, *ray);
  if (isFront)
  {
    *isFront = leavesFront;
  }
}

bool ScatteredRays::scatterSpecularly(const ScatteredRay& leaving, Ray& ray) const
{
  const TriangleId id = leaving.id;
  SurfacePoint point = surfacePoint(sampler_.triangleOf(id), leaving.weights);
  point.turn(leaving.side == 0 ? leaving.incoming.dot(point.normal) <= 0 : leaving.side > 0);
  const Vector3 incoming = incomingDirection(point, leaving.from);
  const auto sample = [&](SampleUse use) {
    return sampler_.samples_.sample(leaving.walk, leaving.bounce, use);
  };
  const LobeSample samples{ sample(SampleUse::Direction), sample(SampleUse::Acceptance)[0],
    sample(SampleUse::Compensation) };
  const PhongLobe& lobe = sampler_.materialOf(id.object).lobeOf(sampler_.cellOf(id));
  ray = { point.clearPosition(), lobe.sample(point.normal, incoming, samples), id };
  return point.isFront;
}

void ScatteredRays::addDiffuse(const ScatteredRay& leaving, Ray* ray, bool* isFront)
{
  lanes_.setTriangle(count_, sampler_.triangleOf(leaving.id));
  lanes_.weights.set(count_, leaving.weights);
  lanes_.incoming.set(count_, leaving.incoming);
  lanes_.side[count_] = leaving.side;
  lanes_.samples.set(count_, sampler_.samples_, leaving.walk, leaving.bounce, SampleUse::Direction);
  ids_[count_] = leaving.id;
  rays_[count_] = ray;
  isFront_[count_] = isFront;
  if (++count_ == ScatterLanes::kSize)
  {
    flush();
  }
}

void ScatteredRays::flush()
{
  if (count_ == 0)
  {
    return;
  }
  scatterAll(lanes_);
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
