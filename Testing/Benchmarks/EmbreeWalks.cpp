#include "EmbreeWalks.h"

#include "Light/Reflection.h"
#include "Light/Roulette.h"
#include "Sampling/DirectionSampling.h"

using namespace irradiance;

EmbreeWalks::EmbreeWalks(
  const SceneObjects& objects, std::uint32_t numberOfWalks, std::uint64_t seed, CellSums& sums)
  : objects_(objects)
  , numberOfWalks_(numberOfWalks)
  , emitters_(objects, numberOfWalks)
  , samples_(seed)
  , sums_(sums)
{
}

EmbreeWalk EmbreeWalks::start(std::uint32_t walk, Ray& ray) const
{
  const WalkStart start = emitters_.start(walk, samples_);
  ray = start.ray;
  return { walk, 1, rouletteThreshold(start.power), start.power };
}

bool EmbreeWalks::goOn(EmbreeWalk& walk, const Vector3& direction, const TriangleId& id,
  const Vector3& weights, Ray& ray)
{
  const SceneObject& object = objects_[id.object];
  const Triangle& triangle = object.body->mesh()[id.triangle];
  SurfacePoint point = surfacePoint(
    id.object == 0 ? triangle : transformed(object.worldFromObject, triangle), weights);
  if (direction.dot(point.normal) > 0)
  {
    point.normal = -point.normal;
  }
  constexpr std::size_t kMany = 4096; // as the engine hands them in
  sums_.collect(walk.walk, id, true, walk.power, 1, deposits_);
  if (deposits_.size() >= kMany)
  {
    handIn();
  }
  walk.power = reflected(walk.power, *object.material, id.triangle);
  if (walk.power.largest() < walk.threshold)
  {
    walk.power = playRoulette(
      walk.power, walk.threshold, samples_.sample(walk.walk, walk.bounce, SampleUse::Roulette)[0]);
  }
  if (walk.power.isZero())
  {
    return false;
  }
  ray = { point.clearPosition(),
    sampleCosineHemisphere(
      point.normal, samples_.sample(walk.walk, walk.bounce, SampleUse::Direction)),
    id };
  ++walk.bounce;
  return true;
}

void EmbreeWalks::handIn()
{
  sums_.add(deposits_);
  deposits_.clear();
}

void EmbreeWalks::prefetchTriangle(const TriangleId& id) const
{
  if (id != TriangleId{})
  {
    const SceneObject& object = objects_[id.object];
    object.body->mesh().prefetch(id.triangle);
    __builtin_prefetch(object.material->cellOfTriangle.data() + id.triangle);
  }
}

void EmbreeWalks::prefetchCell(const TriangleId& id) const
{
  if (id != TriangleId{})
  {
    const Material& material = *objects_[id.object].material;
    __builtin_prefetch(material.reflectance.data() +
      material.cellOfTriangle[id.triangle] * static_cast<std::size_t>(material.bands));
    sums_.prefetch(0, id);
  }
}
