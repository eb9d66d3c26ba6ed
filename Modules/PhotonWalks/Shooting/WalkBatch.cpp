// SPDX-License-Identifier: BSD-3-Clause
#include "Shooting/WalkBatch.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace irradiance
{

void WalkBatch::shoot(std::uint32_t walk)
{
  const WalkStart start = shooter_.start(walk);
  add(walk, 0, start.ray, {}, start.power);
}

void WalkBatch::resume(
  std::uint32_t walk, std::uint32_t bounce, const Ray& ray, const Hit& hit, const Power& incoming)
{
  areHitsKnown_ = true;
  add(walk, bounce, ray, hit, incoming);
}

void WalkBatch::add(
  std::uint32_t walk, std::uint32_t bounce, const Ray& ray, const Hit& hit, const Power& power)
{
  states_.push_back({ static_cast<std::uint32_t>(tails_.size()), bounce, power });
  rays_.push_back(ray);
  hits_.push_back(hit);
  tails_.push_back({ walk, bounce, 0 });
}

bool WalkBatch::run(WalkTally& tally, const std::function<bool()>& hasToStop)
{
  constexpr std::size_t kUsualLength = 4;
  pieces_.reserve(kUsualLength * tails_.size());
  for (; !states_.empty(); ++rounds_)
  {
    if (hasToStop())
    {
      return false;
    }
    // From the end, so that waiting walks stay where they are.
    const std::size_t count =
      rounds_ < kRoundsTogether ? states_.size() : std::min(states_.size(), kPatient);
    const std::size_t first = states_.size() - count;
    if (!areHitsKnown_)
    {
      hits_.resize(rays_.size());
      shooter_.cast(rays_.data() + first, count, hits_.data() + first);
    }
    areHitsKnown_ = false;
    advance(first, tally);
  }
  return true;
}

/// Takes the walks from their hits to their next rays; walks that end drop out.
void WalkBatch::advance(std::size_t first, WalkTally& tally)
{
  constexpr std::size_t kAhead = 8;
  std::size_t kept = first;
  for (std::size_t i = first; i < states_.size(); ++i)
  {
    // What a hit needs is scattered in memory: prefetch it in time, and what leads to it first.
    if (i + 2 * kAhead < states_.size())
    {
      shooter_.prefetchTriangle(hits_[i + 2 * kAhead]);
    }
    if (i + kAhead < states_.size())
    {
      shooter_.prefetchCell(hits_[i + kAhead]);
      tally.prefetch(tails_[states_[i + kAhead].tail].walk, hits_[i + kAhead]);
    }
    State state = states_[i];
    Tail& tail = tails_[state.tail];
    pieces_.push_back({ state.tail, state.bounce,
      { rays_[i], hits_[i], state.power, true, shooter_.isContact(rays_[i].start, hits_[i].id) } });
    ++tail.size;
    const Hit& hit = hits_[i];
    if (!hit)
    {
      tally.add(tail.walk, hit, true, state.power, {}, 1);
      continue;
    }
    const SurfacePoint point = shooter_.scene().surfaceAt(rays_[i].direction, hit);
    pieces_.back().segment.isFront = point.isFront;
    const Power reflectedPower = shooter_.powerAfter(tail.walk, state.bounce, hit.id, state.power);
    tally.add(tail.walk, hit, point.isFront, state.power, reflectedPower, 1);
    if (reflectedPower.isZero())
    {
      continue;
    }
    if (++state.bounce > kMostBounces)
    {
      throw std::runtime_error("walk " + std::to_string(tail.walk) +
        " does not end: the light cannot leave a part of the scene that absorbs nothing "
        "(reflectance 1)");
    }
    state.power = reflectedPower;
    rays_[kept] = shooter_.rayFrom(tail.walk, state.bounce, point, hit.id);
    states_[kept++] = state;
  }
  states_.resize(kept);
  rays_.resize(kept);
}

void WalkBatch::store(const WalkPlan& plan, std::vector<WalkBlock>& history) const
{
  for (const Tail& tail : tails_)
  {
    const WalkPlan::Place place = plan.placeOf(tail.walk);
    history[place.block].replaceTail(place.walkInBlock, tail.bounce, tail.size);
  }
  for (const Piece& piece : pieces_)
  {
    const WalkPlan::Place place = plan.placeOf(tails_[piece.tail].walk);
    history[place.block].setSegment(place.walkInBlock, piece.bounce, piece.segment);
  }
}

}
