// SPDX-License-Identifier: BSD-3-Clause
#include "Shooting/WalkSampler.h"

namespace irradiance
{

Reflection WalkSampler::reflectionAt(
  const TriangleId& hit, std::uint32_t walk, std::uint32_t bounce, const Power& incoming) const
{
  const Material& material = materialOf(hit.object);
  if (!material.isSpecular())
  {
    return Reflection::Diffuse;
  }
  const SurvivalProbabilities probabilities =
    survivalProbabilities(incoming, material, cellOf(hit));
  // Most cells of a shiny object may be matte: what survives there needs no sample.
  return probabilities.specular == 0
    ? Reflection::Diffuse
    : probabilities.chosenBy(samples_.sample(walk, bounce, SampleUse::Survival)[0]);
}

Vector3 WalkSampler::specularDirection(const SurfacePoint& point, const TriangleId& id,
  const Vector3& from, std::uint32_t walk, std::uint32_t bounce) const
{
  const auto sample = [&](SampleUse use) { return samples_.sample(walk, bounce, use); };
  const LobeSample samples{ sample(SampleUse::Direction), sample(SampleUse::Acceptance)[0],
    sample(SampleUse::Compensation) };
  const PhongLobe& lobe = materialOf(id.object).lobeOf(cellOf(id));
  return lobe.sample(point.normal, incomingDirection(point, from), samples);
}

}
