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
    std::fill_n(front.isSpecular.data(), front.size, std::uint8_t{ 0 });
    if (!isOnlyOrigins)
    {
      findSpecular(tracer, history, front);
    }
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

/// Those that leave specularly need to know whence the light came.
void StoredRays::findSpecular(
  const WalkTracer& tracer, const WalkHistory& history, WalkFront& front)
{
  const SceneTriangles& triangles = tracer.triangles();
  specularRows_.clear();
  for (std::size_t row = 0; row < front.size; ++row)
  {
    if (front.bounce[row] == 0 || !triangles.looks()[front.start[row]].isGlossy())
    {
      continue;
    }
    const Power incoming = history.power(SegmentPlace{ front.block[row], front.parent[row] });
    if (tracer.stages().isReflectedSpecularly(
          triangles.idOf(front.start[row]), front.walk[row], front.bounce[row], incoming))
    {
      front.isSpecular[row] = 1;
      specularRows_.push_back(static_cast<std::uint32_t>(row));
    }
  }
  before_.reserve(specularRows_.size(), 1);
  before_.size = specularRows_.size();
  for (std::size_t i = 0; i < specularRows_.size(); ++i)
  {
    before_.block[i] = front.block[specularRows_[i]];
    before_.slot[i] = front.parent[specularRows_[i]];
  }
  std::vector<std::uint32_t> firstRows = std::move(firstRows_); // of the front, not of those before
  find(tracer, history, before_, true);
  firstRows_ = std::move(firstRows);
  for (std::size_t i = 0; i < specularRows_.size(); ++i)
  {
    copyOrigin(before_, i, front, specularRows_[i]);
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
