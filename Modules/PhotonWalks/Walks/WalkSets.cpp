// SPDX-License-Identifier: BSD-3-Clause
#include "Walks/WalkSets.h"

#include <cmath>
#include <utility>

namespace irradiance
{

void WalkSets::setSources(std::vector<WalkSource> sources)
{
  flux_ = 0;
  double quanta = 0, starting = 0;
  std::uint32_t first = 0, most = 0;
  for (const WalkSource& source : sources)
  {
    if (source.isDynamic())
    {
      continue; // the same light as of the static cells
    }
    flux_ += source.lights.flux();
    quanta += static_cast<double>(source.lights.quantaPerWalk()) * source.plan.walksAfter(1);
    starting += static_cast<double>(source.quantaPerWalk()) * source.plan.walksAfter(1);
    first += source.plan.walksAfter(1);
    most += source.plan.most();
  }
  quantaOfFlux_ = std::llround(quanta / first);
  quantaPerWalk_ = std::llround(starting / first);
  plan_ = WalkPlan(first, most, sources.front().plan.replicates().count());
  total_.reset();
  sets_.resize(sources.size());
  for (std::size_t i = 0; i < sources.size(); ++i)
  {
    sets_[i].setSource(std::move(sources[i]));
  }
}

void WalkSets::setSettings(const WalkSettings& settings)
{
  budget_ = settings.repairTimeBudget;
  WalkSettings own = settings;
  for (WalkSet& set : sets_)
  {
    set.setSettings(own);
    own.seed += 0x9e3779b97f4a7c15u; // as SplitMix64 does
  }
  if (total_)
  {
    total_->statistics = {};
  }
}

void WalkSets::follow(const Frame& frame, PhotonChanges* changes, Execution& execution)
{
  double left = budget_;
  // The last ones first: often they have less to do, and leave the others more of the budget.
  inParts(sets_.size(), execution, [&](std::size_t done, Execution& part) {
    const std::size_t i = sets_.size() - 1 - done;
    if (budget_ > 0)
    {
      constexpr double kLeast = 1e-9; // s; 0 would be none
      sets_[i].setBudget(std::max(left / static_cast<double>(i + 1), kLeast));
    }
    sets_[i].follow(frame, changes, part);
    left -= sets_[i].statistics().repairSeconds;
  });
  sumUp(frame.objects, execution);
}

void WalkSets::sumUp(const SceneObjects& objects, Execution& execution)
{
  Ranks& ranks = execution.ranks();
  if (sets_.size() == 1 && !areShared())
  {
    total_.reset();
    return;
  }
  const CancelPoint cancelPoint = cancelPointOf(execution, 1);
  const CellSums& any = sets_.front().sums();
  const bool doGather = std::any_of(
    sets_.begin(), sets_.end(), [](const WalkSet& set) { return set.gathered() != nullptr; });
  const CellPart gatherers{ 0, doGather ? objects.size() : 0 };
  Total total{ CellSums(objects, plan_, 0, gatherers), {}, CellSums(objects), staleOfSets(),
    statisticsOfSets() };
  total.sums.setRounds(any.rounds(), cancelPoint);
  for (const WalkSet& set : sets_)
  {
    total.sums.add(set.sums(), cancelPoint);
    total.balance += set.balance();
    if (set.stale())
    {
      total.staleSums.add(set.stale()->sums(), cancelPoint);
    }
  }
  if (areShared())
  {
    sumOver(ranks, total, cancelPoint);
  }
  total_ = std::move(total);
}

void WalkSets::sumOver(Ranks& ranks, Total& total, const CancelPoint& cancelPoint)
{
  total.sums.sumOver(ranks, cancelPoint);
  irradiance::sumOver(ranks, total.balance);
  std::array<std::int64_t, 7> counts{ total.stale.isKept ? 1 : 0, total.stale.isStale ? 1 : 0,
    total.stale.isBounded ? 0 : 1, total.statistics.suspectSegments, total.statistics.invalidWalks,
    total.statistics.repairedSegments, total.statistics.shotWalks };
  ranks.sum(counts.data(), counts.size());
  total.stale.isKept = counts[0] > 0;
  total.stale.isStale = counts[1] > 0;
  total.stale.isBounded = counts[2] == 0;
  total.statistics.suspectSegments = counts[3];
  total.statistics.invalidWalks = counts[4];
  total.statistics.repairedSegments = counts[5];
  total.statistics.shotWalks = counts[6];
  if (total.stale.isKept)
  {
    ranks.sum(total.stale.carried.quanta.data(), total.stale.carried.quanta.size());
    ranks.sum(total.stale.gain.quanta.data(), total.stale.gain.quanta.size());
    total.staleSums.sumOver(ranks, cancelPoint);
  }
}

WalkSets::StaleFigures WalkSets::staleOfSets() const
{
  StaleFigures all;
  for (const WalkSet& set : sets_)
  {
    if (const StaleWalks* stale = set.stale())
    {
      all.isKept = true;
      all.isStale = all.isStale || set.hasStale();
      all.isBounded = all.isBounded && stale->isBoundKnown();
      const StalePower power = stale->power();
      all.carried += power.carried;
      all.gain += power.gain;
    }
  }
  return all;
}

double WalkSets::escapedError(int band) const
{
  // Of so many walks, each with a photon of full power at most, a binomial number is lost.
  const auto largest = largestStart();
  const auto lost = static_cast<double>(balance().escaped[band] - balance().unmet[band]);
  const auto emitted = static_cast<double>(balance().emitted[band]);
  double variance = lost > 0
    ? *std::max_element(largest.begin(), largest.end()) * lost * std::max(0.0, 1 - lost / emitted)
    : 0;
  for (const WalkSet& set : sets_)
  {
    set.forEachGathered([&](const DirectGather& light) { variance += light.variance(band); });
  }
  return std::sqrt(variance);
}

std::vector<std::uint32_t> WalkSets::first(std::size_t count) const
{
  const std::size_t all = isEmpty() ? 0 : numberOfWalks();
  const std::size_t chosen = std::min(count, all);
  std::vector<std::uint32_t> walks;
  std::size_t before = 0; // walks of this set and of those before it
  for (const WalkSet& set : sets_)
  {
    before += set.plan().walksAfter(set.sums().rounds());
    const auto next = static_cast<std::ptrdiff_t>(walks.size());
    walks.resize(all > 0 ? before * chosen / all : 0);
    std::iota(walks.begin() + next, walks.end(), set.plan().rounds().front().firstWalk);
  }
  return walks;
}

}
