#include "EmbreeShooter.h"

#include "DirectionSampling.h"
#include "Emitter.h"
#include "Reflection.h"

using namespace irradiance;

std::int64_t shootWithEmbree(const EmbreeScene& embree, const SceneObjects& objects,
  std::uint32_t numberOfWalks, std::uint64_t seed, CellSums& sums)
{
  const EmitterTable emitters(objects, numberOfWalks);
  const SobolSequence samples(seed);
  std::int64_t segments = 0;
  for (std::uint32_t walk = 0; walk < numberOfWalks; ++walk)
  {
    WalkStart state = emitters.start(walk, samples);
    const std::int64_t threshold = rouletteThreshold(state.power);
    for (std::uint32_t bounce = 1;; ++bounce)
    {
      ++segments;
      const EmbreeScene::Found found = embree.cast(state.ray);
      if (found.id == TriangleId{})
      {
        break;
      }
      const SceneObject& object = objects[found.id.object];
      const Triangle& triangle = object.body->mesh()[found.id.triangle];
      SurfacePoint point = surfacePoint(
        found.id.object == 0 ? triangle : transformed(object.worldFromObject, triangle),
        found.weights);
      if (state.ray.direction.dot(point.normal) > 0)
      {
        point.normal = -point.normal;
      }
      sums.add(found.id, true, state.power, 1);
      state.power = reflected(state.power, *object.surface, found.id.triangle);
      if (state.power.largest() < threshold)
      {
        state.power = playRoulette(
          state.power, threshold, samples.sample(walk, bounce, SampleUse::Roulette)[0]);
      }
      if (state.power.isZero())
      {
        break;
      }
      state.ray = { point.clearPosition(),
        sampleCosineHemisphere(point.normal, samples.sample(walk, bounce, SampleUse::Direction)),
        found.id };
    }
  }
  return segments;
}
