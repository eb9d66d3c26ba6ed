// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "History/WalkHistory.h"
#include "Shooting/WalkTracer.h"

#include <functional>
#include <vector>

namespace irradiance
{

/**
 * Takes a front of walks to their ends, bounce by bounce: the stages of WalkStages, the cast, the
 * tally and the history. It owns the memory for this, to be used again.
 */
class WalkBatch
{
public:
  /// Begins anew. The arguments must outlive the run. `history`: where segments are stored;
  /// or null.
  void begin(const WalkTracer& tracer, WalkHistory* history);

  /// To be filled: with walks and their blocks, to be started; or with walks whose rays and hits
  /// are known, to go on.
  WalkFront& front() { return now_; }
  /// All walks of the front leave their lights, or the cells where direct light was gathered.
  void start(FrontTally& tally);
  /// All walks of the front go on. `notesPlaces`: see places().
  void resume(bool notesPlaces);

  /// Shoots until all walks have ended. Throws std::runtime_error if they hardly do. If `hasToStop`
  /// returns true between two bounces, it returns false and may be called again, on another thread
  /// and with another tally.
  bool run(FrontTally& tally, const std::function<bool()>& hasToStop);

  /// Segments shot so far.
  std::int64_t numberOfSegments() const { return segments_; }
  /// Where the segments with which walks went on are stored.
  const std::vector<SegmentPlace>& places() const { return places_; }

private:
  /// After this many rounds the few walks that are left are finished kPatient at a time, so that it
  /// shows soon if they are endless.
  static constexpr std::uint32_t kRoundsTogether = 256;
  static constexpr std::size_t kPatient = 2;

  bool isDone();
  void checkEnds() const;
  void store();

  const WalkTracer* tracer_ = nullptr;
  WalkHistory* history_ = nullptr;
  bool areHitsKnown_ = false;
  bool notesPlaces_ = false;
  WalkFront now_, next_;
  WalkFront waiting_; ///< see kRoundsTogether
  FrontCast cast_;
  Column<std::uint8_t> kinds_;
  std::uint32_t rounds_ = 0;
  std::size_t started_ = 0; ///< walks
  std::int64_t segments_ = 0;
  std::vector<SegmentPlace> places_;
};

}
