#ifndef EmbreeShooter_h
#define EmbreeShooter_h

#include "EmbreeScene.h"
#include "Tally/WalkTally.h"

/// How rays are given to Embree.
enum class EmbreeForm
{
  WalkByWalk, ///< rtcIntersect1, one walk after the other
  Batch1,     ///< rtcIntersect1, the rays of many walks bounce by bounce
  Batch8,     ///< rtcIntersect8, likewise
  Batch16     ///< rtcIntersect16, likewise
};

constexpr EmbreeForm kEmbreeForms[] = { EmbreeForm::WalkByWalk, EmbreeForm::Batch1,
  EmbreeForm::Batch8, EmbreeForm::Batch16 };

const char* nameOf(EmbreeForm form);

/// Re-shooting with the best ray tracer: the walks of the engine with Embree in the place of the
/// engine's trees, and nothing stored. In batches the memory is asked in time for what hits need, as
/// the engine does. Returns the number of segments.
std::int64_t shootWithEmbree(EmbreeForm form, const EmbreeScene& embree,
  const irradiance::SceneObjects& objects, std::uint32_t numberOfWalks, std::uint64_t seed,
  irradiance::CellSums& sums);

#endif
