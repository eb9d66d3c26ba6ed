// SPDX-License-Identifier: BSD-3-Clause
#include "DirectLight/WalkStarts.h"

#include <algorithm>
#include <numeric>

namespace irradiance
{

namespace
{

/// A number in [0, 1) of a seed, a sample and a use.
double chance(std::uint64_t seed, std::uint32_t sample, int use)
{
  const std::uint64_t hash =
    splitMix(seed ^ splitMix(static_cast<std::uint64_t>(use) << 32 | sample));
  return static_cast<double>(hash >> 11) * 0x1p-53;
}

/// Of incidence, as of walks that leave from there, see WalkStages.
double cosineOf(const DirectSample& sample, const SceneTriangles& triangles)
{
  const double b = sample.weightB, c = sample.weightC;
  SurfacePoint point = surfacePoint(triangleOf(triangles, sample.triangle), { 1 - b - c, b, c });
  point.turn(sample.isFront);
  return -point.normal.dot((point.position - sample.from).normalized());
}

}

WalkStarts::WalkStarts(const DirectLight& light, const SceneObjects& objects,
  const SceneTriangles& triangles, std::int64_t quantaPerWalk, std::uint32_t firstWalk,
  std::uint64_t seed, const CancelPoint& cancelPoint)
  : light_(light)
  , quantaPerWalk_(quantaPerWalk)
  , firstWalk_(firstWalk)
  , replicates_(light.plan().replicates())
  , seed_(seed)
  , counts_(replicates_, 0)
{
  const DirectPlan& plan = light.plan();
  starts_.reserve(plan.size()); // so it hardly ever moves; what is not used is never mapped
  ThrottledCancelPoint pace(cancelPoint);
  for (std::size_t cell = 0; cell < plan.numberOfCells(); ++cell)
  {
    for (std::uint32_t i = 0; i < plan.samplesOf(cell); ++i)
    {
      if (light.samples()[plan.first(cell) + i].part > 0)
      {
        add(plan.first(cell) + i, plan.replicateOf(cell, i), objects, triangles);
      }
      pace.step();
    }
  }
  numberWalks(cancelPoint);
}

void WalkStarts::add(std::uint32_t number, std::uint32_t replicate, const SceneObjects& objects,
  const SceneTriangles& triangles)
{
  const DirectSample& sample = light_.samples()[number];
  const TriangleId id = triangles.idOf(sample.triangle);
  const Material& material = *objects[id.object].material;
  const Bands arriving = light_.quantaOf(sample);
  const std::size_t cell = material.cellOfTriangle[id.triangle];
  const double cosine = material.isPane(cell) ? cosineOf(sample, triangles) : 1;
  for (int use = 0; use < (material.hasOtherWays() ? static_cast<int>(kLeavings) : 1); ++use)
  {
    const auto way = static_cast<Leaving>(use);
    // What goes straight through clear sheets was looked for beyond.
    const Bands reflected = way == Leaving::Straight && material.isClear(cell)
      ? Bands{}
      : material.partOf(way, cell, cosine) * arriving;
    const double all = std::accumulate(reflected.begin(), reflected.end(), 0.0);
    const auto walks = static_cast<std::uint32_t>(
      all / static_cast<double>(quantaPerWalk_) + chance(seed_, number, use));
    if (walks > 0)
    {
      Power power; // all bands have that of a walk together
      for (std::size_t band = 0; band < reflected.size(); ++band)
      {
        power.quanta[band] =
          nearestQuanta(static_cast<double>(quantaPerWalk_) * (reflected[band] / all));
      }
      starts_.push_back({ number, replicate, counts_[replicate], walks, way, power });
      counts_[replicate] += walks;
    }
  }
}

/// Replicates take turns, as Replicates says.
void WalkStarts::numberWalks(const CancelPoint& cancelPoint)
{
  const std::size_t most = std::max(1u, *std::max_element(counts_.begin(), counts_.end()));
  assignPaced(startOfWalk_, most * replicates_, kNone, cancelPoint);
  ThrottledCancelPoint pace(cancelPoint);
  for (std::uint32_t i = 0; i < starts_.size(); ++i)
  {
    pace.step();
    for (std::uint32_t walk = starts_[i].first; walk < starts_[i].first + starts_[i].count; ++walk)
    {
      startOfWalk_[std::size_t{ walk } * replicates_ + starts_[i].replicate] = i;
    }
  }
}

std::size_t WalkStarts::numberBorn() const
{
  std::size_t number = 0;
  for (const Start& start : starts_)
  {
    const double passed = light_.passedTo(start.sample);
    for (std::uint32_t walk = start.first; walk < start.first + start.count; ++walk)
    {
      number += isBorn(numberOf(start, walk), passed) ? 1 : 0;
    }
  }
  return number;
}

double WalkStarts::evenSample(std::uint64_t walk, std::uint64_t seed)
{
  constexpr int kDigits = 5;
  constexpr std::uint64_t kRow = (1u << kDigits) - 1;
  std::uint64_t reversed = 0;
  for (int digit = 0; digit < kDigits; ++digit)
  {
    reversed |= (walk >> digit & 1) << (63 - digit);
  }
  const std::uint64_t shift = splitMix((walk & ~kRow) ^ seed) & kRow << (64 - kDigits);
  const std::uint64_t within = splitMix(splitMix(walk) ^ seed) >> kDigits;
  return static_cast<double>(((reversed ^ shift) | within) >> 11) * 0x1p-53;
}

std::vector<std::uint32_t> WalkStarts::walksOf(
  const std::vector<DirectLight::Change>& changes) const
{
  std::vector<std::uint32_t> walks;
  for (const auto& [sample, passed] : changes)
  {
    const double passes = light_.passedTo(sample);
    auto start = std::lower_bound(starts_.begin(), starts_.end(), sample,
      [](const Start& some, std::uint32_t number) { return some.sample < number; });
    for (; start != starts_.end() && start->sample == sample; ++start)
    {
      for (std::uint32_t walk = start->first; walk < start->first + start->count; ++walk)
      {
        const std::uint32_t number = numberOf(*start, walk);
        if (isBorn(number, passed) != isBorn(number, passes))
        {
          walks.push_back(number);
        }
      }
    }
  }
  std::sort(walks.begin(), walks.end());
  return walks;
}

}
