// SPDX-License-Identifier: BSD-3-Clause
#ifndef EmbreeShooter_h
#define EmbreeShooter_h

#include "Rivals/EmbreeRays.h"
#include "Rivals/OurCaster.h"
#include "Shooting/WalkShooter.h"
#include "Tally/CellSums.h"

/// Re-shooting with the best ray tracer: the walks of the engine, with Embree in the place of the
/// engine's trees, and nothing stored.
class EmbreeShooter
{
public:
  /// `objects` must outlive this.
  EmbreeShooter(
    const irradiance::SceneObjects& objects, std::uint32_t numberOfWalks, std::uint64_t seed)
    : numberOfWalks_(numberOfWalks)
    , embree_(objects)
    , scene_(makeScene(objects))
    , emitters_(objects, numberOfWalks)
    , samples_(seed)
    , walks_(*scene_, objects, emitters_, samples_)
  {
  }

  /// Shoots that many walks side by side, bounce by bounce, and returns the number of segments.
  template <class Packet, std::uint32_t batchSize>
  std::int64_t shoot(irradiance::CellSums& sums) const
  {
    constexpr std::size_t kManyDeposits = 4096; // as the engine hands them in
    std::int64_t segments = 0;
    EmbreeRays<Packet> rays(embree_, batchSize, embree_.nearest());
    std::vector<State> states(batchSize);
    std::vector<irradiance::Deposit> deposits;
    for (std::uint32_t first = 0; first < numberOfWalks_; first += batchSize)
    {
      std::size_t count = std::min(batchSize, numberOfWalks_ - first);
      for (std::uint32_t i = 0; i < count; ++i)
      {
        const irradiance::WalkStart start = walks_.start(first + i);
        states[i] = { first + i, 0, start.power };
        rays.set(i, start.ray.origin.cast<float>(), start.ray.direction.cast<float>());
      }
      while (count > 0)
      {
        segments += static_cast<std::int64_t>(count);
        rays.cast(count);
        count = goOn(states, count, rays, sums, deposits);
        if (deposits.size() >= kManyDeposits)
        {
          sums.add(deposits);
          deposits.clear();
        }
      }
    }
    sums.add(deposits);
    return segments;
  }

private:
  /// The segment of a walk that is being shot.
  struct State
  {
    std::uint32_t walk, bounce;
    irradiance::Power power;
  };

  /// From the hits of the walks to their next rays; returns how many walks go on.
  template <class Rays>
  std::size_t goOn(std::vector<State>& states, std::size_t count, Rays& rays,
    const irradiance::CellSums& sums, std::vector<irradiance::Deposit>& deposits) const
  {
    // In batches the memory is asked in time for what hits need, as the engine does.
    constexpr std::size_t kAhead = 8;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      if (i + 2 * kAhead < count)
      {
        walks_.prefetchTriangle(rays.hit(i + 2 * kAhead));
      }
      if (i + kAhead < count)
      {
        const irradiance::Hit ahead = rays.hit(i + kAhead);
        walks_.prefetchCell(ahead);
        sums.prefetch(states[i + kAhead].walk, ahead.id);
      }
      const irradiance::Hit hit = rays.hit(i);
      if (!hit)
      {
        continue;
      }
      State state = states[i];
      const irradiance::SurfacePoint point = scene_->surfaceAt(rays.direction(i), hit);
      sums.collect(state.walk, hit.id, point.isFront, state.power, 1, deposits);
      state.power = walks_.powerAfter(state.walk, state.bounce, hit.id, state.power);
      if (!state.power.isZero())
      {
        const irradiance::Ray ray = walks_.rayFrom(state.walk, ++state.bounce, point, hit.id);
        rays.set(
          kept, ray.origin.cast<float>(), ray.direction.cast<float>()); // its hit has been read
        states[kept++] = state;
      }
    }
    return kept;
  }

  std::uint32_t numberOfWalks_;
  EmbreeScene embree_;
  std::shared_ptr<const irradiance::Scene> scene_; ///< tells the points of hits; casts nothing
  irradiance::EmitterTable emitters_;
  irradiance::SobolSequence samples_;
  irradiance::WalkShooter walks_;
};

/// A way to give rays to Embree.
struct EmbreeForm
{
  const char* name;
  std::int64_t (EmbreeShooter::*shoot)(irradiance::CellSums& sums) const;
};

// As many walks side by side as the engine's. From 256 to 16384 the times hardly differ.
constexpr EmbreeForm kEmbreeForms[] = { { "rtcIntersect1, walk by walk",
                                          &EmbreeShooter::shoot<RTCRayHit, 1> },
  { "rtcIntersect1, in batches", &EmbreeShooter::shoot<RTCRayHit, 1024> },
  { "rtcIntersect8, in batches", &EmbreeShooter::shoot<RTCRayHit8, 1024> },
  { "rtcIntersect16, in batches", &EmbreeShooter::shoot<RTCRayHit16, 1024> } };

#endif
