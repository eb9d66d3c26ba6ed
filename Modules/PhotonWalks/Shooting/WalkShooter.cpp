// SPDX-License-Identifier: BSD-3-Clause
#include "Shooting/WalkShooter.h"

#include "Light/Absorption.h"
#include "Sampling/DirectionSampling.h"

namespace irradiance
{

Power WalkShooter::powerAfter(
  std::uint32_t walk, std::uint32_t bounce, const TriangleId& id, const Power& incoming) const
{
  const Material& material = *objects_[id.object].material;
  const double probability = survivalProbability(incoming, material, id.triangle);
  return samples_.sample(walk, bounce + 1, SampleUse::Survival)[0] < probability
    ? survivingPower(incoming, material, id.triangle, probability)
    : Power{};
}

void WalkShooter::cast(const Ray* rays, std::size_t count, Hit* hits) const
{
  scene_.cast(rays, count, hits);
  const bool mayTouch = contacts_ && !contacts_->isEmpty();
  for (std::size_t i = 0; mayTouch && i < count; ++i)
  {
    hits[i] = contacts_->settled(scene_, rays[i], hits[i]);
  }
}

void WalkShooter::prefetchTriangle(const Hit& hit) const
{
  if (hit)
  {
    const SceneObject& object = objects_[hit.id.object];
    object.body->mesh().prefetch(hit.id.triangle);
    prefetchLine(object.material->cellOfTriangle.data() + hit.id.triangle);
  }
}

void WalkShooter::prefetchCell(const Hit& hit) const
{
  if (hit)
  {
    const Material& material = *objects_[hit.id.object].material;
    prefetchLine(material.reflectance.data() +
      material.cellOfTriangle[hit.id.triangle] * static_cast<std::size_t>(material.bands));
  }
}

Ray WalkShooter::rayFrom(
  std::uint32_t walk, std::uint32_t bounce, const SurfacePoint& point, const TriangleId& id) const
{
  return { point.clearPosition(),
    sampleCosineHemisphere(point.normal, samples_.sample(walk, bounce, SampleUse::Direction)), id };
}

Ray WalkShooter::rayOf(
  const WalkBlock& block, std::uint32_t walkInBlock, std::uint32_t walk, std::uint32_t bounce) const
{
  if (bounce == 0)
  {
    return start(walk).ray;
  }
  const Hit left = block.hit(walkInBlock, bounce - 1);
  return rayFrom(
    walk, bounce, scene_.surfaceOf(left, block.isFront(walkInBlock, bounce - 1)), left.id);
}

}
