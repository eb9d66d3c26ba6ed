// SPDX-License-Identifier: BSD-3-Clause
#include "FinalGather/FinalGather.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace irradiance
{

void FinalGather::update(const FinalGatherScene& scene, std::size_t rounds, Execution& execution)
{
  indirect_ = CellSums::ofGathered(scene.frame.objects, scene.known.plan(), 1);
  stale_ = CellSums::ofGathered(scene.frame.objects, {}, scene.knownStale ? 1 : 0);
  noise_ = CellSums::ofGathered(scene.frame.objects, {}, scene.tellsNoise ? 1 : 0);
  followed_ = read_ = 0;
  gatherers_.clear();
  scene.frame.cells.numbers().forEach([&](const SceneCell& cell) {
    if (scene.roles.gathers(cell))
    {
      gatherers_.push_back(cell);
    }
  });
  Ranks& ranks = execution.ranks();
  const DealtBlocks dealt(ranks.rank(), ranks.count());
  PathsOrigin origin(scene, gatherers_);
  const std::optional<FinalGatherMotion> motion =
    origin_ && dealt == dealt_ ? FinalGatherMotion::since(*origin_, scene, origin) : std::nullopt;
  origin_.reset(); // until the end is reached
  dealt_ = dealt;
  const std::size_t together = startsTogether(scene);
  const std::size_t units = (gatherers_.size() + together - 1) / together;
  if (!motion)
  {
    units_ = std::vector<Unit>(units);
    keptRounds_ = 0;
  }
  keptRounds_ = std::max(rounds, keptRounds_); // all follow a motion
  Rounds followed;
  for (std::size_t round = 0; round < keptRounds_; ++round)
  {
    followed.push_back(scene.inRound(round));
  }
  forEachSliced(units, execution, [&](std::size_t unit) {
    if (dealt_.contains(unit))
    {
      gather(followed, rounds, motion ? &*motion : nullptr, unit);
    }
  });
  segments_ = read_;
  if (ranks.areSeveral())
  {
    ranks.sum(&segments_, 1);
    indirect_.sumOver(ranks, cancelPointOf(execution, 1));
    stale_.sumOver(ranks, cancelPointOf(execution, 1));
    noise_.sumOver(ranks, cancelPointOf(execution, 1));
  }
  if (scene.keepsPaths)
  {
    origin_ = std::move(origin);
  }
  else
  {
    units_.clear();
  }
}

void FinalGather::dropRounds(std::size_t kept)
{
  if (kept == 0)
  {
    units_.clear();
    origin_.reset();
  }
  for (Unit& unit : units_)
  {
    unit.rounds.resize(std::min(kept, unit.rounds.size()));
  }
  keptRounds_ = std::min(kept, keptRounds_);
}

std::size_t FinalGather::bytes() const
{
  std::size_t bytes =
    indirect_.bytes() + stale_.bytes() + noise_.bytes() + gatherers_.capacity() * sizeof(SceneCell);
  for (const Unit& unit : units_)
  {
    bytes += unit.sides.capacity() * sizeof(Side) + unit.rounds.size() * sizeof(FollowedPaths);
    bytes = std::accumulate(unit.rounds.begin(), unit.rounds.end(), bytes,
      [](std::size_t sum, const FollowedPaths& paths) { return sum + paths.bytes(); });
  }
  return bytes;
}

std::vector<FinalGather::Side> FinalGather::sidesOf(
  const FinalGatherScene& scene, std::size_t unit) const
{
  const std::size_t together = startsTogether(scene);
  const std::size_t end = std::min((unit + 1) * together, gatherers_.size());
  std::vector<Side> sides;
  for (std::size_t i = unit * together; i < end; ++i)
  {
    const CellShape& shape = scene.shapes[scene.frame.cells.numbers()[gatherers_[i]]];
    for (const int side : { 0, 1 })
    {
      if (!(side == 0 ? shape.isFrontDark : shape.isBackDark))
      {
        sides.push_back({ i, side, scene.roles.timesOf(gatherers_[i]) });
      }
    }
  }
  return sides;
}

void FinalGather::gather(
  const Rounds& rounds, std::size_t read, const FinalGatherMotion* motion, std::size_t number)
{
  const FinalGatherScene& scene = rounds.front();
  Unit& unit = units_[number];
  std::vector<Side> sides = sidesOf(scene, number);
  if (!(motion && sides == unit.sides))
  {
    unit.rounds.clear();
  }
  unit.sides = std::move(sides);
  const std::size_t kept = unit.rounds.size();
  unit.rounds.resize(rounds.size());
  for (std::size_t round = 0; round < rounds.size(); ++round)
  {
    if (round >= kept || !motion->isNone())
    {
      follow(rounds[round], round < kept ? motion : nullptr, unit.sides, unit.rounds[round]);
    }
  }
  std::vector<PathSums> brought;
  for (std::size_t round = 0; round < read; ++round)
  {
    brought.emplace_back(rounds[round], unit.rounds[round]);
    read_ += static_cast<std::int64_t>(unit.rounds[round].numberOfSegments());
  }
  std::size_t start = 0;
  for (const Side& side : unit.sides)
  {
    store(scene, brought, start, side);
    if (scene.tellsNoise)
    {
      storeNoise(scene, brought, start, side);
    }
    start += side.starts;
  }
  while (!scene.keepsPaths && !unit.rounds.empty())
  {
    forgotten_.giveBack(std::make_unique<FollowedPaths>(std::move(unit.rounds.back())));
    unit.rounds.pop_back();
  }
}

void FinalGather::follow(const FinalGatherScene& scene, const FinalGatherMotion* motion,
  const std::vector<Side>& sides, FollowedPaths& paths)
{
  std::vector<std::size_t> from;
  std::vector<std::uint32_t> rays;
  const auto addStarts = [&](FinalGatherPaths& following) {
    for (const Side& side : sides)
    {
      const SceneCell& cell = gatherers_[side.gatherer];
      rays.clear();
      for (std::uint32_t ray = 0; ray < side.starts * scene.rays; ++ray)
      {
        const bool isAnew =
          !motion || motion->hasMoved(cell.object) || motion->mayChange(paths[from.size()]);
        from.push_back(isAnew ? FollowedPaths::kAnew : from.size());
        if (isAnew)
        {
          rays.push_back(scene.firstRay(side.starts) + ray);
        }
      }
      if (!rays.empty())
      {
        // By the place among sides that gather. The number of its cell would not do: absent cells
        // have numbers in a frame that follows others, and none in a fresh one.
        const std::uint64_t number = 2 * side.gatherer + static_cast<std::uint64_t>(side.side);
        following.addSide(scene.frame.cells.numbers()[cell], side.side == 0, number, rays);
      }
    }
  };
  std::unique_ptr<FollowedPaths> memory = forgotten_.take();
  FollowedPaths anew = FinalGatherPaths::follow(paths_, scene, addStarts, std::move(*memory));
  followed_ += static_cast<std::int64_t>(anew.size());
  paths = motion ? anew.mergedWith(paths, from) : std::move(anew);
}

void FinalGather::store(const FinalGatherScene& scene, const std::vector<PathSums>& brought,
  std::size_t start, const Side& side)
{
  const CellSide cell{ gatherers_[side.gatherer], side.side };
  const double areaOfStart = scene.frame.cells.area(cell) / side.starts;
  const auto sumOf = [&](const auto& found) {
    Bands all{};
    for (std::size_t round = 0; round < brought.size(); ++round)
    {
      Bands sum{};
      for (std::size_t i = start; i < start + side.starts; ++i)
      {
        sum += found(brought[round], i);
      }
      all += shareOfRound(round, brought.size()) * sum;
    }
    return areaOfStart * all;
  };
  for (std::uint32_t k = 0; k < indirect_.plan().replicates().count(); ++k)
  {
    indirect_.setGathered(
      cell, k, sumOf([&](const PathSums& sums, std::size_t i) { return sums.found(i, k); }));
  }
  if (scene.knownStale)
  {
    stale_.setGathered(
      cell, 0, sumOf([&](const PathSums& sums, std::size_t i) { return sums.stale(i); }));
  }
}

/// The last round has half of all rays. Where it is the first, it is halved itself.
void FinalGather::storeNoise(const FinalGatherScene& scene, const std::vector<PathSums>& brought,
  std::size_t start, const Side& side)
{
  const CellSide cell{ gatherers_[side.gatherer], side.side };
  const double areaOfStart = scene.frame.cells.area(cell) / side.starts;
  const std::size_t last = brought.size() - 1;
  const std::uint32_t rays = scene.raysOfReplicate(), halves = rays / 2 * 2;
  Bands noise{}; // squared
  for (std::uint32_t k = 0; k < scene.replicates(); ++k)
  {
    Bands difference{};
    for (std::size_t at = start; at < start + side.starts; ++at)
    {
      for (std::size_t round = 0; last > 0 && round <= last; ++round)
      {
        const double share = shareOfRound(round, brought.size());
        difference += (round < last ? share : -share) * brought[round].found(at, k);
      }
      difference += last == 0 ? brought[0].difference(at, k) : Bands{};
    }
    noise += difference * difference;
  }
  // Of an odd number of rays the one in the middle is in no half.
  const double middle = last == 0 && halves > 0 ? static_cast<double>(rays) / halves : 1;
  for (double& ofBand : noise)
  {
    ofBand = areaOfStart * std::sqrt(middle * ofBand);
  }
  noise_.setGathered(cell, 0, noise);
}

}
