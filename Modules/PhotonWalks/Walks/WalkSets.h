// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "History/WalkHistory.h"
#include "Shooting/StoredRays.h"
#include "Walks/WalkSet.h"

#include <algorithm>
#include <cassert>
#include <deque>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

namespace irradiance
{

/**
 * All sets of walks in a scene, and what they bring together. They are shot, verified and repaired
 * one after the other. Walks of all sets have different numbers. A quantum is as many watts in
 * each, so what they bring adds up in integers, over the sets and over the ranks. Of a single set
 * on a single rank, the total is what the set holds; nothing is copied.
 */
class WalkSets
{
public:
  WalkSets() = default;
  WalkSets(const WalkSets&) = delete;
  WalkSets& operator=(const WalkSets&) = delete;

  /// The plan of the walks that settings ask for.
  static WalkPlan planOf(const WalkSettings& settings)
  {
    assert(settings.replicates >= (settings.targetRelativeError > 0 ? 2u : 1u));
    return { settings.numberOfWalks,
      settings.targetRelativeError > 0 ? settings.maximumNumberOfWalks : settings.numberOfWalks,
      settings.replicates };
  }

  /// Before the start: a set for each.
  void setSources(std::vector<WalkSource> sources);
  bool hasSources(const std::vector<WalkSource>& sources) const
  {
    return std::equal(sets_.begin(), sets_.end(), sources.begin(), sources.end(),
      [](const WalkSet& set, const WalkSource& source) { return set.source() == source; });
  }
  /// Whether these have only another number of walks, and those that both have may stay: all are
  /// stored, or there are more. Of several sets the numbers of most walks would change.
  bool areResizedBy(const std::vector<WalkSource>& sources, bool areStored) const
  {
    return sets_.size() == 1 && sources.size() == 1 &&
      sets_.front().isResizedBy(sources.front(), areStored);
  }
  /// What follows does in each set what WalkSet says. A budget of time is shared evenly, but for
  /// what a set does not need.
  void setSettings(const WalkSettings& settings);
  void start(const Frame& frame, Execution& execution)
  {
    inEach(frame, execution, [&](WalkSet& set, Execution& part) { set.start(frame, part); });
  }
  void shootRound(std::size_t round, bool isStored, const Frame& frame, Execution& execution)
  {
    inEach(frame, execution,
      [&](WalkSet& set, Execution& part) { set.shootRound(round, isStored, frame, part); });
  }
  void dropRounds(std::size_t kept, const Frame& frame, Execution& execution)
  {
    inEach(frame, execution, [&](WalkSet& set, Execution& part) {
      set.dropRounds(kept, frame.triangles, cancelPointOf(part, 1));
    });
  }
  void follow(const Frame& frame, PhotonChanges* changes, Execution& execution);
  void resize(bool areStored, const Frame& frame, Execution& execution)
  {
    sets_.front().resize(areStored, frame.triangles, cancelPointOf(execution, 0));
  }
  void shootMissing(bool areStored, const Frame& frame, Execution& execution)
  {
    inEach(frame, execution,
      [&](WalkSet& set, Execution& part) { set.shootMissing(areStored, frame, part); });
  }
  void replaceCells(const Frame& frame, Execution& execution)
  {
    inEach(frame, execution,
      [&](WalkSet& set, Execution& part) { set.replaceCells(frame, cancelPointOf(part, 0)); });
  }
  void forgetBudget()
  {
    for (WalkSet& set : sets_)
    {
      set.forgetBudget();
    }
    if (total_ && !total_->stale.isStale)
    {
      total_->stale.isKept = staleOfSets().isKept;
    }
  }

  /// With the walks of this rank.
  const std::vector<WalkSet>& sets() const { return sets_; }
  /// Whether the walks of the last start were dealt to the same ranks; or whether all of them are
  /// here.
  bool areOf(const Ranks& ranks, bool all) const { return sets_.front().isOf(ranks, all); }
  /// Whether other ranks have some of the walks.
  bool areShared() const { return sets_.front().isShared(); }
  /// Whether there are no lights.
  bool isEmpty() const { return flux_ == 0; }
  /// Bounds of the lights in the air.
  Box boundsInAir() const
  {
    Box bounds;
    for (const WalkSet& set : sets_)
    {
      bounds.add(set.lights().boundsInAir());
    }
    return bounds;
  }
  /// Of their lights, see LightTable.
  bool mayTouchWalls() const
  {
    return std::any_of(
      sets_.begin(), sets_.end(), [](const WalkSet& set) { return set.lights().mayTouchWalls(); });
  }
  /// Walks stay inside, except where they escape.
  Box bounds(const Scene& scene) const
  {
    Box bounds = scene.bounds();
    bounds.add(boundsInAir());
    return bounds;
  }
  /// The walks of all sets, round by round.
  const WalkPlan& plan() const { return plan_; }
  /// See WalkSet.
  const CellSums& sums() const { return total_ ? total_->sums : sets_.front().sums(); }
  const PowerBalance& balance() const { return total_ ? total_->balance : sets_.front().balance(); }
  /// The number of walks shot; more than in the settings if a target needs them.
  std::uint32_t numberOfWalks() const { return plan_.walksAfter(sums().rounds()); }
  /// Of these, those that were shot: none without lights, and at cells as many as were born.
  std::int64_t numberOfShotWalks() const
  {
    std::int64_t number = 0;
    for (const WalkSet& set : sets_)
    {
      number += set.gathered() || isEmpty() ? 0 : set.plan().walksAfter(set.sums().rounds());
      set.forEachGathered([&](const DirectGather& light) {
        number += static_cast<std::int64_t>(light.starts().numberBorn());
      });
    }
    return number;
  }
  /// The standard error of what escapes, and as all the rest is absorbed, of that: quanta, rather
  /// too large.
  double escapedError(int band) const;
  /// With which a walk starts, in all bands together; of several sets, on average.
  std::int64_t quantaPerWalk() const { return quantaPerWalk_; }
  /// Quanta with which a walk may start at most, in each band.
  Bands largestStart() const
  {
    Bands largest{};
    for (const WalkSet& set : sets_)
    {
      largest = larger(largest, set.largestStart());
    }
    return largest;
  }
  double watts(double quanta) const { return watts(quanta, sums().rounds()); }
  /// Of what the first rounds brought.
  double watts(double quanta, std::size_t rounds) const
  {
    return flux_ * (quanta / (static_cast<double>(quantaOfFlux_) * plan_.walksAfter(rounds)));
  }

  WalkHistories histories() const
  {
    WalkHistories all;
    for (const WalkSet& set : sets_)
    {
      all.push_back(&set.history());
    }
    return all;
  }
  std::size_t numberOfBlocks() const
  {
    return std::accumulate(sets_.begin(), sets_.end(), std::size_t{},
      [](std::size_t sum, const WalkSet& set) { return sum + set.history().size(); });
  }
  /// Memory held.
  std::size_t bytes() const
  {
    return std::accumulate(sets_.begin(), sets_.end(), total_ ? total_->sums.bytes() : 0,
      [](std::size_t sum, const WalkSet& set) { return sum + set.bytes(); });
  }
  /// The `count` first walks, or all: of each set its share.
  std::vector<std::uint32_t> first(std::size_t count) const;

  bool hasStale() const { return total_ ? total_->stale.isStale : sets_.front().hasStale(); }
  /// The power that stale tails brought to the cells; null without a budget, or before anything
  /// moved.
  const CellSums* staleSums() const
  {
    if (total_)
    {
      return total_->stale.isKept ? &total_->staleSums : nullptr;
    }
    const StaleWalks* stale = sets_.front().stale();
    return stale ? &stale->sums() : nullptr;
  }
  /// The power that the first stale segments carry, and a bound of what their new tails bring;
  /// quanta.
  Power stalePower() const { return staleFigures().carried; }
  /// Infinite where no bound is known.
  double staleGainBound(int band) const
  {
    const StaleFigures stale = staleFigures();
    return stale.isBounded || stale.carried[band] == 0 ? static_cast<double>(stale.gain[band])
                                                       : std::numeric_limits<double>::infinity();
  }

  /// What was done since the settings were made.
  WalkStatistics statistics() const { return total_ ? total_->statistics : statisticsOfSets(); }

private:
  /// What is stale in all sets.
  struct StaleFigures : StalePower
  {
    bool isKept = false; ///< there are sums of what is stale
    bool isStale = false;
    bool isBounded = true;
  };
  struct Total
  {
    CellSums sums;
    PowerBalance balance;
    CellSums staleSums;
    StaleFigures stale;
    WalkStatistics statistics;
  };
  /// Calls work(set, part of the execution) for each, and sums up.
  template <class Work>
  void inEach(const Frame& frame, Execution& execution, const Work& work)
  {
    inParts(sets_.size(), execution, [&](std::size_t i, Execution& part) { work(sets_[i], part); });
    sumUp(frame.objects, execution);
  }
  /// Sums up what the sets of all ranks hold, unless it is a single one.
  void sumUp(const SceneObjects& objects, Execution& execution);
  static void sumOver(Ranks& ranks, Total& total, const CancelPoint& cancelPoint);
  StaleFigures staleOfSets() const;
  StaleFigures staleFigures() const { return total_ ? total_->stale : staleOfSets(); }
  WalkStatistics statisticsOfSets() const
  {
    return std::accumulate(sets_.begin(), sets_.end(), WalkStatistics(),
      [](WalkStatistics sum, const WalkSet& set) { return sum += set.statistics(); });
  }

  std::vector<WalkSet> sets_ = std::vector<WalkSet>(1);
  std::optional<Total> total_; ///< of several
  WalkPlan plan_;
  double budget_ = 0;             ///< of time, s; 0: none
  double flux_ = 0;               ///< W
  std::int64_t quantaOfFlux_ = 1, ///< divided by the number of walks
    quantaPerWalk_ = 1;
};

/// Reads the stored walks of all sets in a frame.
class StoredWalks
{
public:
  /// The arguments, and what the space refers to, must outlive it.
  StoredWalks(const WalkSets& sets, const Frame& frame)
  {
    for (const WalkSet& set : sets.sets())
    {
      readers_.emplace_back(set, frame);
    }
  }

  /// The set to which a walk belongs.
  const WalkSet& setOf(std::uint32_t walk) const { return readerOf(walk).set; }
  const WalkHistory& historyOf(std::uint32_t walk) const { return setOf(walk).history(); }
  /// What a walk does where it starts and at its hits.
  const WalkStages& stages(std::uint32_t walk) const { return readerOf(walk).tracer.stages(); }
  /// See StoredRays; segments of any sets.
  void raysOf(const std::vector<SegmentRef>& segments, Ray* rays) const
  {
    StoredRays stored;
    for (auto begin = segments.begin(); begin != segments.end();)
    {
      const Reader& reader = readerOf(begin->walk);
      const auto end = std::find_if(begin, segments.end(),
        [&](const SegmentRef& segment) { return &readerOf(segment.walk) != &reader; });
      stored.find(reader.tracer, reader.set.history(), { begin, end }, rays);
      rays += end - begin;
      begin = end;
    }
  }

private:
  /// Of one set.
  struct Reader
  {
    Reader(const WalkSet& walks, const Frame& frame)
      : set(walks)
      , samples(walks.samples())
      , tracer(walks.tracer(frame, samples))
    {
    }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    const WalkSet& set;
    SobolSequence samples;
    WalkTracer tracer; ///< refers to samples
  };

  const Reader& readerOf(std::uint32_t walk) const
  {
    return *std::find_if(readers_.begin(), std::prev(readers_.end()),
      [walk](const Reader& reader) { return walk < reader.set.plan().endWalk(); });
  }

  std::deque<Reader> readers_;
};

}
