// SPDX-License-Identifier: BSD-3-Clause
#include "Shooting/WalkBatch.h"

#include "Surfaces/Absorption.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace irradiance
{

namespace
{

constexpr std::size_t kAhead = 8; // hits between a request to memory and its use

}

WalkBatch::WalkBatch(const WalkTracer& tracer, const UnitFrame* storedIn, bool storesSides)
  : tracer_(tracer)
  , frame_(storedIn)
  , storesSides_(storesSides)
{
}

void WalkBatch::shoot(const std::vector<std::uint32_t>& walks)
{
  const WalkSampler& sampler = tracer_.sampler();
  const std::size_t first = walks_.size(), all = first + walks.size();
  reserve(walks.size());
  for (const std::uint32_t walk : walks)
  {
    addTail({ walk, 0 });
  }
  walks_.insert(walks_.end(), walks.begin(), walks.end());
  bounces_.resize(all, 0);
  if (sampler.bands() == 1)
  {
    emitted_ += static_cast<std::int64_t>(walks.size()) * sampler.powerPerWalk();
  }
  else
  {
    for (const std::uint32_t walk : walks)
    {
      powers_.push_back(sampler.powerOf(walk));
      emitted_ += powers_.back();
    }
  }
  rays_.resize(all);
  sampler.start(walks.data(), walks.size(), rays_.data() + first);
}

void WalkBatch::reserve(std::size_t walks)
{
  const std::size_t all = walks_.size() + walks;
  tailOf_.reserve(all);
  walks_.reserve(all);
  bounces_.reserve(all);
  tails_.reserve(all);
  rays_.reserve(all);
  hits_.reserve(all);
  constexpr std::size_t kUsualLength = 3;
  pieces_.reserve(frame_ ? kUsualLength * all : 0);
  ends_.reserve(frame_ ? all : 0);
}

void WalkBatch::resume(
  const SegmentRef& first, const Ray& ray, const Hit& hit, const Power& incoming)
{
  areHitsKnown_ = true;
  addTail(first);
  walks_.push_back(first.walk);
  bounces_.push_back(first.bounce);
  if (tracer_.sampler().bands() > 1)
  {
    powers_.push_back(incoming);
  }
  rays_.push_back(ray);
  hits_.push_back(hit);
}

void WalkBatch::addTail(const SegmentRef& first)
{
  tailOf_.push_back(static_cast<std::uint32_t>(tails_.size()));
  tails_.push_back({ first, 0 });
}

bool WalkBatch::run(WalkTally& tally, const std::function<bool()>& hasToStop)
{
  for (; !walks_.empty(); ++rounds_)
  {
    if (hasToStop())
    {
      return false;
    }
    // From the end, so that waiting walks stay where they are.
    const std::size_t count =
      rounds_ < kRoundsTogether ? walks_.size() : std::min(walks_.size(), kPatient);
    const std::size_t first = walks_.size() - count;
    if (!areHitsKnown_)
    {
      hits_.resize(walks_.size());
      tracer_.cast(rays_.data() + first, count, hits_.data() + first);
    }
    areHitsKnown_ = false;
    segments_ += static_cast<std::int64_t>(count);
    findCells(first, tally);
    if (tally.sides() == 2)
    {
      findSides(first);
    }
    receive(first, tally);
    tally.check();
    absorb(first);
    if (frame_)
    {
      record(first);
    }
    leave(first, tally);
  }
  return true;
}

/// What a hit needs is scattered in memory: it is prefetched in time, and what leads to it first.
void WalkBatch::findCells(std::size_t first, WalkTally& tally)
{
  const WalkSampler& sampler = tracer_.sampler();
  const std::size_t end = hits_.size();
  cells_.resize(end - first);
  slots_.resize(end - first);
  for (std::size_t i = first; i < std::min(first + kAhead, end); ++i)
  {
    sampler.prefetchTriangle(hits_[i]);
  }
  for (std::size_t i = first; i < end; ++i)
  {
    if (i + kAhead < end)
    {
      sampler.prefetchTriangle(hits_[i + kAhead]);
    }
    if (hits_[i])
    {
      cells_[i - first] = sampler.cellOf(hits_[i].id);
      sampler.prefetchCell(hits_[i]);
      slots_[i - first] = tally.slotOf(walks_[i], { hits_[i].id.object, cells_[i - first] });
      tally.prefetch(slots_[i - first]);
    }
  }
}

void WalkBatch::findSides(std::size_t first)
{
  isFront_.resize(hits_.size() - first);
  for (std::size_t i = first; i < hits_.size(); ++i)
  {
    isFront_[i - first] = !hits_[i] || tracer_.sampler().hitsFront(rays_[i], hits_[i].id);
  }
}

void WalkBatch::receive(std::size_t first, WalkTally& tally)
{
  const std::size_t count = hits_.size() - first;
  if (powers_.empty())
  {
    std::size_t received = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      slots_[received] = isFront(i) ? slots_[i] : tally.backOf(slots_[i]);
      received += hits_[first + i] ? 1 : 0;
    }
    slots_.resize(received);
    tally.receive(slots_, tracer_.sampler().powerPerWalk());
    tally.escape(static_cast<std::int64_t>(count - received), tracer_.sampler().powerPerWalk());
    return;
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    if (hits_[first + i])
    {
      tally.receive(slots_[i], isFront(i), powers_[first + i]);
    }
    else
    {
      tally.escape(1, powers_[first + i]);
    }
  }
}

/// Keeps what will be stored of the segments. The sides of those that go on follow when they leave.
void WalkBatch::record(std::size_t first)
{
  const WalkSampler& sampler = tracer_.sampler();
  const std::size_t count = hits_.size() - first;
  isSurvivor_.assign(count, 0);
  for (const std::uint32_t survivor : survivors_)
  {
    isSurvivor_[survivor - first] = 1;
  }
  const std::size_t firstPiece = pieces_.size();
  pieces_.resize(firstPiece + count);
  std::size_t ends = ends_.size();
  ends_.resize(ends + count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const Ray& ray = rays_[first + i];
    const Hit& hit = hits_[first + i];
    const std::uint32_t tail = tailOf_[first + i];
    const bool isSideUnknown = storesSides_ && isFront_.empty() && isSurvivor_[i] == 0 && hit;
    ++tails_[tail].size;
    pieces_[firstPiece + i] = { tail,
      { storedPoint(*frame_, ray.origin), hit.id, hit.weights,
        isSideUnknown ? sampler.hitsFront(ray, hit.id) : isFront(i),
        tracer_.isContact(ray.start, hit.id) } };
    // Written for all, counted for those that end: which do is unpredictable.
    const double length = hit ? hit.distance : WalkBlock::kFar / frame_->scale;
    ends_[ends] = { tail, storedPoint(*frame_, ray.origin + length * ray.direction) };
    ends += isSurvivor_[i] != 0 ? 0 : 1;
  }
  ends_.resize(ends);
  if (!powers_.empty())
  {
    piecePowers_.insert(
      piecePowers_.end(), powers_.begin() + static_cast<std::ptrdiff_t>(first), powers_.end());
  }
}

void WalkBatch::absorb(std::size_t first)
{
  const WalkSampler& sampler = tracer_.sampler();
  const std::size_t count = hits_.size() - first;
  probabilities_.resize(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const Hit& hit = hits_[first + i];
    probabilities_[i] = !hit ? 0
      : powers_.empty()
      ? sampler.reflectanceOf(hit.id.object, cells_[i])
      : survivalProbabilities(powers_[first + i], sampler.materialOf(hit.id.object), cells_[i])
          .total();
  }
  survivors_.clear();
  sampler.survive(walks_.data() + first, bounces_.data() + first, probabilities_.data(), count,
    static_cast<std::uint32_t>(first), survivors_);
}

/// Takes the walks that survived from their hits to their next rays, without gaps between them. A
/// place is written only after it was read, as no survivor moves up.
void WalkBatch::leave(std::size_t first, WalkTally& tally)
{
  const WalkSampler& sampler = tracer_.sampler();
  ScatteredRays scattered(sampler);
  std::size_t kept = first;
  Piece* const pieces = frame_ ? &pieces_[pieces_.size() - (hits_.size() - first)] : nullptr;
  for (const std::uint32_t i : survivors_)
  {
    const Hit& hit = hits_[i];
    checkEnd(i);
    const double side = isFront_.empty() ? 0 : isFront(i - first) ? 1 : -1;
    tailOf_[kept] = tailOf_[i];
    walks_[kept] = walks_[i];
    bounces_[kept] = bounces_[i] + 1;
    const Reflection reflection = sampler.reflectionAt(
      hit.id, walks_[kept], bounces_[kept], powers_.empty() ? Power{} : powers_[i]);
    scattered.add({ walks_[kept], bounces_[kept], hit.id, weightsOf(hit), side, rays_[i].direction,
                    reflection, rays_[i].origin },
      &rays_[kept], pieces ? &pieces[i - first].segment.isFront : nullptr);
    if (!powers_.empty())
    {
      const Material& material = sampler.materialOf(hit.id.object);
      const std::size_t cell = cells_[i - first];
      const double probability = material.isSpecular()
        ? survivalProbabilities(powers_[i], material, cell).of(reflection)
        : probabilities_[i - first];
      powers_[kept] = survivingPower(powers_[i], material, cell, reflection, probability);
      tally.release(1, powers_[kept]);
    }
    ++kept;
  }
  if (powers_.empty())
  {
    tally.release(static_cast<std::int64_t>(kept - first), sampler.powerPerWalk());
  }
  scattered.flush();
  tailOf_.resize(kept);
  walks_.resize(kept);
  bounces_.resize(kept);
  rays_.resize(kept);
  hits_.resize(kept);
  powers_.resize(powers_.empty() ? 0 : kept);
}

void WalkBatch::checkEnd(std::size_t place) const
{
  if (bounces_[place] >= kMostBounces)
  {
    throw std::runtime_error("walk " + std::to_string(walks_[place]) +
      " does not end: the light cannot leave a part of the scene that absorbs nothing "
      "(reflectance 1)");
  }
}

std::vector<std::uint32_t> WalkBatch::sizes() const
{
  std::vector<std::uint32_t> sizes(tails_.size());
  std::transform(
    tails_.begin(), tails_.end(), sizes.begin(), [](const Tail& tail) { return tail.size; });
  return sizes;
}

void WalkBatch::store(WalkHistory& history) const
{
  struct Cursor
  {
    WalkBlock* block;
    SegmentRef next;
  };
  std::vector<Cursor> cursors;
  cursors.reserve(tails_.size());
  for (std::size_t i = 0; i < tails_.size(); ++i)
  {
    if (i + kAhead < tails_.size())
    {
      const std::uint32_t later = tails_[i + kAhead].first.walk;
      history.blockOf(later).prefetchPlace(later);
    }
    const Tail& tail = tails_[i];
    WalkBlock& block = history.blockOf(tail.first.walk);
    block.replaceTail(tail.first, tail.size);
    cursors.push_back({ &block, tail.first });
  }
  for (std::size_t i = 0; i < pieces_.size(); ++i)
  {
    Cursor& cursor = cursors[pieces_[i].tail];
    cursor.block->setSegment(cursor.next, pieces_[i].segment);
    if (!piecePowers_.empty())
    {
      cursor.block->setPower(cursor.next, piecePowers_[i]);
    }
    ++cursor.next.bounce;
  }
  for (const End& end : ends_)
  {
    cursors[end.tail].block->setEnd(cursors[end.tail].next.walk, end.point);
  }
}

}
