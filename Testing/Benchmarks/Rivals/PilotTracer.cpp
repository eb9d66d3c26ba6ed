// SPDX-License-Identifier: BSD-3-Clause
#include "Rivals/PilotTracer.h"

#include "Measuring/Rounds.h"
#include "Rivals/OurCaster.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <numeric>

using namespace irradiance;

namespace
{

/// Fowler, Noll and Vo's hash, of words.
template <class Value>
void mixIn(std::uint64_t& hash, Value value)
{
  std::uint64_t word = 0;
  static_assert(sizeof value <= sizeof word);
  std::memcpy(&word, &value, sizeof value);
  hash = (hash ^ word) * 0x100000001b3u;
  hash ^= hash >> 29;
}

}

PilotTracer::PilotTracer(
  const SceneObjects& objects, std::uint32_t walks, std::uint64_t seed, const StartStrata& strata)
  : plan_(walks, walks, 1)
  , strata_(strata)
  , lights_(objects, walks)
  , samples_(seed)
  , groups_(strata.numberOfGroups())
{
  for (std::uint32_t walk = 0; walk < walks; ++walk)
  {
    groupOfWalk_.push_back(groupOf(walk));
    groups_[groupOfWalk_.back()].push_back(walk);
  }
  shootAll(objects);
}

void PilotTracer::shootAll(const SceneObjects& objects)
{
  objects_ = objects;
  scene_ = makeScene(objects);
  triangles_.update(objects);
  sums_ = CellSums(objects, 1);
  balance_ = {};
  const int bands = objects.staticObject.material->bands;
  history_ = WalkHistory(plan_, PointGrid(scene_->bounds()), triangles_.numbers(), bands,
    Power{ { lights_.quantaPerWalk() } },
    std::make_shared<BlockArena>(BounceBlock::pageBytes(bands)));
  for (std::size_t block = 0; block < plan_.rounds().back().endBlock; ++block)
  {
    history_.append();
  }
  shoot(allWalks());
}

PilotTracer::Walks PilotTracer::allWalks() const
{
  Walks all(plan_.most());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

std::uint32_t PilotTracer::groupOf(std::uint32_t walk) const
{
  const auto stratumOf = [](double sample, int bits) {
    return static_cast<std::uint32_t>(std::ldexp(sample, bits));
  };
  const std::array<double, 2> direction = samples_.sample(walk, 0, SampleUse::Direction);
  std::uint32_t group =
    stratumOf(samples_.sample(walk, 0, SampleUse::Light)[0], strata_.emitterBits);
  for (const double coordinate : direction)
  {
    group = group << strata_.directionBits | stratumOf(coordinate, strata_.directionBits);
  }
  return group;
}

void PilotTracer::shoot(const Walks& walks)
{
  constexpr std::size_t kBatchSize = WalkFront::kUsualSize;
  const WalkTracer tracer(*scene_, objects_, triangles_, lights_, samples_);
  const int bands = history_.bands();
  for (std::size_t first = 0; first < walks.size(); first += kBatchSize)
  {
    const std::size_t count = std::min(kBatchSize, walks.size() - first);
    batch_.begin(tracer, &history_, false);
    WalkFront& front = batch_.front();
    front.reserve(count, bands);
    front.size = count;
    old_.size = 0;
    Power starting;
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::uint32_t walk = walks[first + i];
      const std::size_t number = history_.indexOf(walk);
      front.walk[i] = walk;
      front.block[i] = static_cast<std::uint32_t>(number);
      const BounceBlock& block = history_.block(number);
      const std::uint32_t slot = block.begin(walk);
      if (slot != BounceBlock::kNone)
      {
        starting += block.power(slot);
        history_.removeFrom(
          { number, slot }, [&](std::uint32_t each) { addStored(block, each, bands, old_); });
      }
    }
    FrontTally tally(triangles_, sums_, balance_, tracer.sampler().powerPerWalk(), 4 * count);
    tally.remove(old_, starting);
    tally.unemit(starting);
    batch_.start(tally);
    batch_.run(tally, [] { return false; });
  }
}

std::size_t PilotTracer::update(const SceneObjects& objects, double share, double seconds)
{
  const double start = threadCpuSeconds();
  objects_ = objects;
  scene_ = makeScene(objects);
  triangles_.update(objects);
  // The pilots of a group are some of its walks in a row, from frame to frame the next ones.
  Walks pilots;
  std::vector<bool> isPilot(plan_.most());
  for (const Walks& group : groups_)
  {
    const auto count =
      static_cast<std::size_t>(std::ceil(share * static_cast<double>(group.size())));
    for (std::size_t i = 0; i < count; ++i)
    {
      pilots.push_back(group[(frame_ * count + i) % group.size()]);
      isPilot[pilots.back()] = true;
    }
  }
  ++frame_;
  std::sort(pilots.begin(), pilots.end()); // as they stand in memory
  const std::vector<std::uint64_t> old = signaturesOf(pilots);
  shoot(pilots);
  std::size_t shot = pilots.size();
  const std::vector<std::size_t> flagged = flag(pilots, old);
  // With all the time in the world the order of groups is of no use, and the order of memory is
  // faster.
  const std::size_t together = std::isinf(seconds) ? groups_.size() : 64;
  for (std::size_t first = 0; first < flagged.size() && threadCpuSeconds() - start < seconds;
       first += together)
  {
    Walks walks;
    for (std::size_t i = first; i < std::min(first + together, flagged.size()); ++i)
    {
      const Walks& group = groups_[flagged[i]];
      std::copy_if(group.begin(), group.end(), std::back_inserter(walks),
        [&](std::uint32_t walk) { return !isPilot[walk]; });
    }
    std::sort(walks.begin(), walks.end());
    shoot(walks);
    shot += walks.size();
  }
  return shot;
}

std::vector<std::size_t> PilotTracer::flag(
  const Walks& pilots, const std::vector<std::uint64_t>& old) const
{
  const std::vector<std::uint64_t> now = signaturesOf(pilots);
  std::vector<double> changed(groups_.size()), all(groups_.size());
  for (std::size_t i = 0; i < pilots.size(); ++i)
  {
    const std::uint32_t group = groupOfWalk_[pilots[i]];
    all[group] += 1;
    changed[group] += now[i] != old[i] ? 1 : 0;
  }
  std::vector<std::size_t> flagged;
  for (std::size_t group = 0; group < groups_.size(); ++group)
  {
    if (changed[group] > 0)
    {
      flagged.push_back(group);
    }
  }
  std::stable_sort(flagged.begin(), flagged.end(),
    [&](std::size_t a, std::size_t b) { return changed[a] / all[a] > changed[b] / all[b]; });
  return flagged;
}

std::uint64_t PilotTracer::signatureOf(std::uint32_t walk) const
{
  const BounceBlock& block = history_.block(history_.indexOf(walk));
  std::uint64_t hash = 0xcbf29ce484222325u;
  block.forEachFrom(block.begin(walk), [&](std::uint32_t slot) {
    mixIn(hash, block.triangle(slot));
    for (const auto weight : block.weights(slot))
    {
      mixIn(hash, weight);
    }
    mixIn(hash, block.power(slot)[0]);
  });
  return hash;
}

std::vector<std::uint64_t> PilotTracer::signaturesOf(const Walks& walks) const
{
  std::vector<std::uint64_t> signatures;
  std::transform(walks.begin(), walks.end(), std::back_inserter(signatures),
    [this](std::uint32_t walk) { return signatureOf(walk); });
  return signatures;
}

std::vector<std::uint64_t> PilotTracer::signatures() const
{
  return signaturesOf(allWalks());
}
