// SPDX-License-Identifier: BSD-3-Clause
#include "Walks/WalkSets.h"

#include "Execution/ProgressSpan.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

namespace irradiance
{

namespace
{

/// Calls work(set, execution) for each set, each with its part of the progress.
template <class Work>
void forEach(std::vector<WalkSet>& sets, Execution& execution, const Work& work)
{
  const auto count = static_cast<double>(sets.size());
  for (std::size_t i = 0; i < sets.size(); ++i)
  {
    const auto number = static_cast<double>(i);
    ProgressSpan span(execution, number / count, (number + 1) / count);
    work(sets[i], span);
  }
}

}

WalkPlan WalkSets::planOf(const WalkSettings& settings)
{
  assert(settings.replicates >= (settings.targetRelativeError > 0 ? 2u : 1u));
  return { settings.numberOfWalks,
    settings.targetRelativeError > 0 ? settings.maximumNumberOfWalks : settings.numberOfWalks,
    settings.replicates };
}

void WalkSets::setSources(std::vector<WalkSource> sources)
{
  flux_ = 0;
  double quanta = 0;
  std::uint32_t first = 0, most = 0;
  for (const WalkSource& source : sources)
  {
    flux_ += source.lights.flux();
    quanta += static_cast<double>(source.lights.quantaPerWalk()) * source.plan.walksAfter(1);
    first += source.plan.walksAfter(1);
    most += source.plan.most();
  }
  quantaPerWalk_ = std::llround(quanta / first);
  plan_ = WalkPlan(first, most, sources.front().plan.replicates().count());
  total_.reset();
  sets_.resize(sources.size());
  for (std::size_t i = 0; i < sources.size(); ++i)
  {
    sets_[i].setSource(std::move(sources[i]));
  }
}

bool WalkSets::hasSources(const std::vector<WalkSource>& sources) const
{
  return std::equal(sets_.begin(), sets_.end(), sources.begin(), sources.end(),
    [](const WalkSet& set, const WalkSource& source) { return set.source() == source; });
}

void WalkSets::setSettings(const WalkSettings& settings)
{
  WalkSettings own = settings;
  own.repairTimeBudget /= static_cast<double>(sets_.size());
  for (WalkSet& set : sets_)
  {
    set.setSettings(own);
    own.seed += 0x9e3779b97f4a7c15u; // as SplitMix64 does
  }
}

void WalkSets::start(const WalkSpace& space, Execution& execution)
{
  forEach(sets_, execution, [&](WalkSet& set, Execution& part) { set.start(space, part); });
  sumUp(space.objects, cancelPointOf(execution, 1));
}

void WalkSets::shootRound(
  std::size_t round, bool isStored, const WalkSpace& space, Execution& execution)
{
  forEach(sets_, execution,
    [&](WalkSet& set, Execution& part) { set.shootRound(round, isStored, space, part); });
  sumUp(space.objects, cancelPointOf(execution, 1));
}

void WalkSets::dropRounds(
  std::size_t kept, const SceneObjects& objects, const CancelPoint& cancelPoint)
{
  for (WalkSet& set : sets_)
  {
    set.dropRounds(kept, cancelPoint);
  }
  sumUp(objects, cancelPoint);
}

void WalkSets::follow(const std::vector<bool>& moved, const WalkSpace& space,
  PhotonChanges* changes, Execution& execution)
{
  forEach(sets_, execution,
    [&](WalkSet& set, Execution& part) { set.follow(moved, space, changes, part); });
  sumUp(space.objects, cancelPointOf(execution, 1));
}

void WalkSets::replaceCells(const SceneObjects& objects, const CancelPoint& cancelPoint)
{
  for (WalkSet& set : sets_)
  {
    set.replaceCells(objects, cancelPoint);
  }
  sumUp(objects, cancelPoint);
}

void WalkSets::findSides(const WalkSpace& space, Execution& execution)
{
  forEach(sets_, execution, [&](WalkSet& set, Execution& part) { set.findSides(space, part); });
}

void WalkSets::forgetBudget()
{
  for (WalkSet& set : sets_)
  {
    set.forgetBudget();
  }
}

void WalkSets::sumUp(const SceneObjects& objects, const CancelPoint& cancelPoint)
{
  if (sets_.size() == 1)
  {
    return;
  }
  const CellSums& any = sets_.front().sums();
  Total total{ CellSums(objects, any.sides(), plan_, 0), {}, CellSums(objects, any.sides()) };
  total.sums.setRounds(any.rounds(), cancelPoint);
  for (const WalkSet& set : sets_)
  {
    total.sums.add(set.sums(), cancelPoint);
    total.balance += set.balance();
    if (set.stale())
    {
      total.stale.add(set.stale()->sums(), cancelPoint);
    }
  }
  total_ = std::move(total);
}

Box WalkSets::boundsInAir() const
{
  Box bounds;
  for (const WalkSet& set : sets_)
  {
    bounds.add(set.lights().boundsInAir());
  }
  return bounds;
}

Box WalkSets::bounds(const Scene& scene) const
{
  Box bounds = scene.bounds();
  bounds.add(boundsInAir());
  return bounds;
}

std::array<double, Power::kMaxBands> WalkSets::largestStart() const
{
  std::array<double, Power::kMaxBands> largest{};
  for (const WalkSet& set : sets_)
  {
    const auto its = set.lights().largestStart();
    std::transform(its.begin(), its.end(), largest.begin(), largest.begin(),
      [](double a, double b) { return std::max(a, b); });
  }
  return largest;
}

WalkHistories WalkSets::histories() const
{
  std::vector<const WalkHistory*> all;
  for (const WalkSet& set : sets_)
  {
    all.push_back(&set.history());
  }
  return WalkHistories(std::move(all));
}

std::size_t WalkSets::numberOfBlocks() const
{
  return std::accumulate(sets_.begin(), sets_.end(), std::size_t{},
    [](std::size_t sum, const WalkSet& set) { return sum + set.history().size(); });
}

std::size_t WalkSets::bytes() const
{
  return std::accumulate(sets_.begin(), sets_.end(), total_ ? total_->sums.bytes() : 0,
    [](std::size_t sum, const WalkSet& set) { return sum + set.bytes(); });
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

const WalkSet& WalkSets::of(std::uint32_t walk) const
{
  return *std::find_if(sets_.begin(), std::prev(sets_.end()),
    [walk](const WalkSet& set) { return walk < set.plan().endWalk(); });
}

bool WalkSets::hasStale() const
{
  return std::any_of(sets_.begin(), sets_.end(), [](const WalkSet& set) { return set.hasStale(); });
}

const CellSums* WalkSets::staleSums() const
{
  const auto isKept = [](const WalkSet& set) { return set.stale() != nullptr; };
  if (std::none_of(sets_.begin(), sets_.end(), isKept))
  {
    return nullptr;
  }
  return total_ ? &total_->stale : &sets_.front().stale()->sums();
}

Power WalkSets::stalePower() const
{
  Power power;
  for (const WalkSet& set : sets_)
  {
    power += set.stale() ? set.stale()->power() : Power{};
  }
  return power;
}

double WalkSets::staleGainBound(int band) const
{
  return std::accumulate(sets_.begin(), sets_.end(), 0.0, [&](double sum, const WalkSet& set) {
    return sum + (set.stale() ? set.stale()->gainBound(band) : 0);
  });
}

WalkStatistics WalkSets::statistics() const
{
  WalkStatistics sum;
  for (const WalkSet& set : sets_)
  {
    sum += set.statistics();
  }
  return sum;
}

}
