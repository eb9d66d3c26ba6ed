// SPDX-License-Identifier: BSD-3-Clause
#include "Shooting/StoredRays.h"

#include <algorithm>
#include <utility>

namespace irradiance
{

namespace
{

constexpr std::size_t kAhead = 16; // rows between a request to memory and its use

/// What is stored of a hit, to a row and two columns of the front.
void readHit(const BounceBlock& block, std::uint32_t slot, WalkFront& front, std::size_t row,
  Column<std::uint32_t>& triangles, Column<std::uint8_t>& sides)
{
  const std::array<float, 2> weights = block.weights(slot);
  triangles[row] = block.triangle(slot);
  front.weightB[row] = weights[0];
  front.weightC[row] = weights[1];
  sides[row] = block.isFront(slot) ? 1 : 0;
}

void copyOrigin(const WalkFront& from, std::size_t row, WalkFront& to, std::size_t place)
{
  to.originX[place] = from.originX[row];
  to.originY[place] = from.originY[row];
  to.originZ[place] = from.originZ[row];
}

void copyRay(const WalkFront& from, std::size_t row, WalkFront& to, std::size_t place)
{
  copyOrigin(from, row, to, place);
  to.directionX[place] = from.directionX[row];
  to.directionY[place] = from.directionY[row];
  to.directionZ[place] = from.directionZ[row];
  to.start[place] = from.start[row];
  to.side[place] = from.side[row];
}

}

void addStored(const BounceBlock& block, std::uint32_t slot, int bands, WalkFront& front)
{
  const std::size_t row = front.size++;
  if (front.walk.room() < front.size || front.bands < bands)
  {
    front.reserve(2 * front.size, bands);
  }
  front.walk[row] = block.walkOf(slot);
  front.hit[row] = block.triangle(slot);
  front.hitSide[row] = block.isFront(slot) ? 1 : 0;
  if (bands > 1)
  {
    front.setPower(row, bands, block.power(slot));
  }
}

void StoredRays::find(const WalkTracer& tracer, const WalkHistory& history, WalkFront& front)
{
  find(tracer, history, front, false);
  for (std::size_t row = 0; row < front.size; ++row)
  {
    readHit(history.block(front.block[row]), front.slot[row], front, row, front.hit, front.hitSide);
  }
}

void StoredRays::find(
  const WalkTracer& tracer, const WalkHistory& history, WalkFront& front, bool isOnlyOrigins)
{
  readStarts(history, front);
  if (tracer.triangles().hasGlossy())
  {
    findWays(tracer, history, front, isOnlyOrigins);
  }
  tracer.stages().leave(front);
  findFirst(tracer, front);
}

/// What walks leave: the hits of the segments before.
void StoredRays::readStarts(const WalkHistory& history, WalkFront& front)
{
  firstRows_.clear();
  for (std::size_t row = 0; row < front.size; ++row)
  {
    if (row + kAhead < front.size) // its link has been read by whoever chose it
    {
      const BounceBlock& block = history.block(front.block[row + kAhead]);
      const std::uint32_t before = block.previous(front.slot[row + kAhead]);
      if (before != BounceBlock::kNone)
      {
        block.prefetchHit(before);
      }
    }
    const BounceBlock& block = history.block(front.block[row]);
    const std::uint32_t slot = front.slot[row], parent = block.previous(slot);
    front.walk[row] = block.walkOf(slot);
    front.parent[row] = parent;
    front.bounce[row] = block.bounceOf(slot);
    front.start[row] = WalkFront::kNone;
    front.weightB[row] = front.weightC[row] = 0;
    front.side[row] = 1;
    if (parent == BounceBlock::kNone)
    {
      firstRows_.push_back(static_cast<std::uint32_t>(row));
      continue;
    }
    readHit(block, parent, front, row, front.start, front.side);
  }
}

/// How walks leave, and so from which side. Those that leave sharply need to know whence the light
/// came; at a pane that also decides how they leave.
void StoredRays::findWays(
  const WalkTracer& tracer, const WalkHistory& history, WalkFront& front, bool isOnlyOrigins)
{
  const WalkStages& stages = tracer.stages();
  const auto isPaneAt = [&](std::size_t row) {
    const TriangleId id = tracer.triangles().idOf(front.start[row]);
    return stages.materialOf(id.object).isPane(stages.cellOf(id));
  };
  const auto choose = [&](std::size_t row, double cosine) {
    const Power incoming = history.power(SegmentPlace{ front.block[row], front.parent[row] });
    front.leaving[row] = stages.leavingOf(tracer.triangles().idOf(front.start[row]),
      front.walk[row], front.bounce[row], incoming, cosine);
    front.side[row] = (front.side[row] != 0) != isThrough(front.leaving[row]) ? 1 : 0;
  };
  sharpRows_.clear();
  std::fill_n(front.leaving.data(), front.size, Leaving::Diffuse);
  for (std::uint32_t row = 0; row < front.size; ++row)
  {
    if (front.bounce[row] == 0 || !tracer.triangles().looks()[front.start[row]].isGlossy())
    {
      continue;
    }
    const bool isPane = isPaneAt(row);
    if (!isPane)
    {
      choose(row, 1);
    }
    if (isPane || (isSharp(front.leaving[row]) && !isOnlyOrigins))
    {
      sharpRows_.push_back(row);
    }
  }
  if (!sharpRows_.empty())
  {
    findOriginsBefore(tracer, history, front);
  }
  for (const std::uint32_t row : sharpRows_)
  {
    const bool isPane = isPaneAt(row);
    if (isPane || front.leaving[row] == Leaving::Straight)
    {
      const bool cameToFront = (front.side[row] != 0) != isThrough(front.leaving[row]);
      const double cosine = stages.goStraight(front, row, front.start[row], cameToFront);
      isPane ? choose(row, cosine) : void();
    }
  }
  if (isOnlyOrigins)
  {
    std::fill_n(front.leaving.data(), front.size, Leaving::Diffuse);
  }
}

void StoredRays::findOriginsBefore(
  const WalkTracer& tracer, const WalkHistory& history, WalkFront& front)
{
  if (!before_)
  {
    before_ = std::make_unique<StoredRays>();
  }
  WalkFront& before = before_->named_;
  before.reserve(sharpRows_.size(), 1);
  before.size = sharpRows_.size();
  for (std::size_t i = 0; i < sharpRows_.size(); ++i)
  {
    before.block[i] = front.block[sharpRows_[i]];
    before.slot[i] = front.parent[sharpRows_[i]];
  }
  before_->find(tracer, history, before, true);
  for (std::size_t i = 0; i < sharpRows_.size(); ++i)
  {
    copyOrigin(before, i, front, sharpRows_[i]);
  }
}

/// The first rays of walks.
void StoredRays::findFirst(const WalkTracer& tracer, WalkFront& front)
{
  first_.reserve(firstRows_.size(), tracer.stages().bands());
  first_.size = firstRows_.size();
  for (std::size_t i = 0; i < firstRows_.size(); ++i)
  {
    first_.walk[i] = front.walk[firstRows_[i]];
  }
  tracer.stages().start(first_);
  for (std::size_t i = 0; i < firstRows_.size(); ++i)
  {
    copyRay(first_, i, front, firstRows_[i]);
  }
}

void StoredRays::find(const WalkTracer& tracer, const WalkHistory& history,
  const std::vector<SegmentRef>& segments, Ray* rays)
{
  named_.reserve(segments.size(), 1);
  named_.size = segments.size();
  for (std::size_t row = 0; row < segments.size(); ++row)
  {
    const SegmentPlace place = history.placeOf(segments[row]);
    named_.block[row] = static_cast<std::uint32_t>(place.block);
    named_.slot[row] = place.slot;
  }
  find(tracer, history, named_);
  for (std::size_t row = 0; row < segments.size(); ++row)
  {
    rays[row] = tracer.rayOf(named_, row);
  }
}

}
