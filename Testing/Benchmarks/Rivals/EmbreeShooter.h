#ifndef EmbreeShooter_h
#define EmbreeShooter_h

#include "Rivals/EmbreeScene.h"
#include "Shooting/WalkShooter.h"
#include "Tally/CellSums.h"

#include <array>

/// Re-shooting with the best ray tracer: the walks of the engine, with Embree in the place of the
/// engine's trees, and nothing stored.
class EmbreeShooter
{
public:
  /// A way to give rays to Embree.
  struct Form
  {
    const char* name;
    /// Returns the number of segments.
    std::int64_t (EmbreeShooter::*shoot)(irradiance::CellSums& sums) const;
  };
  static const std::array<Form, 4> kForms;

  /// `objects` must outlive this.
  EmbreeShooter(
    const irradiance::SceneObjects& objects, std::uint32_t numberOfWalks, std::uint64_t seed);

private:
  /// The segment of a walk that is being shot.
  struct State
  {
    std::uint32_t walk, bounce;
    std::int64_t threshold; ///< of Russian roulette
    irradiance::Power power;
  };

  /// Shoots that many walks side by side, bounce by bounce.
  template <class Packet, std::uint32_t batchSize>
  std::int64_t shoot(irradiance::CellSums& sums) const;
  /// From the hits of the walks to their next rays; returns how many walks go on.
  template <class Rays>
  std::size_t goOn(std::vector<State>& states, std::size_t count, Rays& rays,
    const irradiance::CellSums& sums, std::vector<irradiance::Deposit>& deposits) const;

  std::uint32_t numberOfWalks_;
  EmbreeScene embree_;
  std::shared_ptr<const irradiance::Scene> scene_; ///< tells the points of hits; casts nothing
  irradiance::EmitterTable emitters_;
  irradiance::SobolSequence samples_;
  irradiance::WalkShooter walks_;
};

#endif
