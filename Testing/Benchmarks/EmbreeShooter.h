#ifndef EmbreeShooter_h
#define EmbreeShooter_h

#include "EmbreeScene.h"
#include "PowerBalance.h"

/// Re-shooting with the best ray tracer: the walks of the engine (same lights, samples, reflection,
/// roulette and sums) with rtcIntersect1 in the place of the engine's trees, and nothing stored.
/// Returns the number of segments.
std::int64_t shootWithEmbree(const EmbreeScene& embree, const irradiance::SceneObjects& objects,
  std::uint32_t numberOfWalks, std::uint64_t seed, irradiance::CellSums& sums);

#endif
