// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_WalkBatch_h
#define irradiance_WalkBatch_h

#include "Shooting/WalkShooter.h"
#include "Tally/WalkTally.h"

#include <functional>
#include <vector>

namespace irradiance
{

/// Shoots many walks side by side, one bounce of all after the other, so that their rays are cast
/// together.
class WalkBatch
{
public:
  explicit WalkBatch(const WalkShooter& shooter)
    : shooter_(shooter)
  {
  }

  /// A whole walk.
  void shoot(std::uint32_t walk);
  /// A walk from segment `bounce` on, whose new hit is known. `first` is the power with which the
  /// walk started, `incoming` what the segment carries.
  void resume(std::uint32_t walk, std::uint32_t bounce, const Ray& ray, const Hit& hit,
    const Power& first, const Power& incoming);

  /// Goes on until all walks have ended, or until `hasToStop` says so between two bounces; then it
  /// returns false and may be called again.
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
  /// Those of a walk in order, those of several mixed.
  const std::vector<Piece>& pieces() const { return pieces_; }
  /// Puts what was shot in the place of what the walks had from there on.
  void store(const WalkPlan& plan, std::vector<WalkBlock>& history) const;

private:
  /// A walk that needs more is in a closed scene that absorbs nothing: it would never end.
  static constexpr std::uint32_t kMostBounces = 1u << 20;
  /// After so many rounds, the few walks that go on are finished a few at a time: should they be
  /// endless, that shows soon.
  static constexpr std::uint32_t kRoundsTogether = 256;
  static constexpr std::size_t kPatient = 2;

  /// The segment of a walk that is being shot.
  struct State
  {
    std::uint32_t tail;
    std::uint32_t bounce;
    std::int64_t threshold; ///< of Russian roulette
    Power power;
  };

  void add(std::uint32_t walk, std::uint32_t bounce, const Ray& ray, const Hit& hit,
    const Power& power, std::int64_t threshold);
  void advance(std::size_t first, WalkTally& tally);

  const WalkShooter& shooter_;
  std::vector<State> states_; ///< of the walks that go on, with their rays and hits
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
  bool areHitsKnown_ = false;
  std::uint32_t rounds_ = 0;
  std::vector<Tail> tails_;
  std::vector<Piece> pieces_;
};

}

#endif
