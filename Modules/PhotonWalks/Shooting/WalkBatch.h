// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_WalkBatch_h
#define irradiance_WalkBatch_h

#include "Shooting/WalkShooter.h"
#include "Tally/WalkTally.h"

#include <functional>
#include <vector>

namespace irradiance
{

/// Shoots many walks side by side, bounce by bounce, so that their rays are cast together.
class WalkBatch
{
public:
  explicit WalkBatch(const WalkShooter& shooter)
    : shooter_(shooter)
  {
  }

  /// Adds a whole walk.
  void shoot(std::uint32_t walk);
  /// Adds a walk from segment `bounce` on, whose ray and new hit are known. `incoming`: what the
  /// segment carries.
  void resume(std::uint32_t walk, std::uint32_t bounce, const Ray& ray, const Hit& hit,
    const Power& incoming);

  /// Shoots until all walks have ended. If `hasToStop` returns true between two bounces, it returns
  /// false and may be called again.
  bool run(WalkTally& tally, const std::function<bool()>& hasToStop);

  struct Tail
  {
    std::uint32_t walk;
    std::uint32_t bounce; ///< of its first segment
    std::uint32_t size;   ///< segments
  };
  struct Piece
  {
    std::uint32_t tail;
    std::uint32_t bounce;
    WalkSegment segment;
  };
  /// In the order in which the walks were added.
  const std::vector<Tail>& tails() const { return tails_; }
  /// In order within a walk; those of several walks are mixed.
  const std::vector<Piece>& pieces() const { return pieces_; }
  /// Replaces the stored tails of the walks by what was shot.
  void store(const WalkPlan& plan, std::vector<WalkBlock>& history) const;

private:
  /// A walk that needs more is in a closed scene that absorbs nothing: it would never end.
  static constexpr std::uint32_t kMostBounces = 1u << 20;
  /// After this many rounds the few walks that are left are finished kPatient at a time, so that it
  /// shows soon if they are endless.
  static constexpr std::uint32_t kRoundsTogether = 256;
  static constexpr std::size_t kPatient = 2;

  /// The segment of a walk that is being shot.
  struct State
  {
    std::uint32_t tail;
    std::uint32_t bounce;
    Power power;
  };

  void add(
    std::uint32_t walk, std::uint32_t bounce, const Ray& ray, const Hit& hit, const Power& power);
  void advance(std::size_t first, WalkTally& tally);

  const WalkShooter& shooter_;
  std::vector<State> states_; ///< of the walks that continue, with their rays and hits
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
  bool areHitsKnown_ = false;
  std::uint32_t rounds_ = 0;
  std::vector<Tail> tails_;
  std::vector<Piece> pieces_;
};

}

#endif
