// SPDX-License-Identifier: BSD-3-Clause
#include "History/WalkBlock.h"

#include <algorithm>

namespace irradiance
{

WalkBlock::WalkBlock(std::uint32_t firstWalk, std::uint32_t numberOfWalks, int bands,
  const UnitFrame& frame, const Power& power)
  : firstWalk_(firstWalk)
  , frame_(frame)
  , places_(numberOfWalks)
  , power_(power)
  , storedBands_(bands > 1 ? static_cast<std::size_t>(bands) : 0)
{
}

Hit WalkBlock::hit(const SegmentRef& segment) const
{
  const std::size_t place = hitOf(segment);
  Hit hit;
  hit.id = ids_[place];
  hit.weights = weights_[place];
  return hit;
}

Power WalkBlock::power(const SegmentRef& segment) const
{
  if (storedBands_ == 0)
  {
    return power_;
  }
  Power power;
  const std::size_t first = hitOf(segment) * storedBands_;
  std::copy_n(
    powers_.begin() + static_cast<std::ptrdiff_t>(first), storedBands_, power.quanta.begin());
  return power;
}

double WalkBlock::shortestLength(const SegmentRef& segment) const
{
  const Vector3 from = point(pointOf(segment)), to = point(pointOf(segment) + 1);
  const double largest = std::max(from.cwiseAbs().maxCoeff(), to.cwiseAbs().maxCoeff());
  return std::max(0.0, (to - from).norm() - 0x1p-20 * largest) / frame_.scale;
}

void WalkBlock::setPoint(std::size_t i, const StoredPoint& point)
{
  x_[i] = point[0];
  y_[i] = point[1];
  z_[i] = point[2];
}

void WalkBlock::setPower(const SegmentRef& segment, const Power& power)
{
  const std::size_t first = hitOf(segment) * storedBands_;
  std::copy_n(
    power.quanta.begin(), storedBands_, powers_.begin() + static_cast<std::ptrdiff_t>(first));
}

void WalkBlock::makeRoom(const std::vector<std::uint32_t>& sizes)
{
  std::uint32_t points = 0, hits = 0;
  for (std::size_t i = 0; i < places_.size(); ++i)
  {
    places_[i] = { points, hits, 0, sizes[i] };
    points += places_[i].points();
    hits += sizes[i];
  }
  resizePools(points, hits);
}

void WalkBlock::replaceTail(const SegmentRef& first, std::uint32_t count)
{
  for (std::uint32_t i = first.bounce + 1; i < size(first.walk) && !staticHits_.empty(); ++i)
  {
    staticHits_.erase(key({ first.walk, i }));
  }
  const std::uint32_t needed = first.bounce + count;
  if (needed > rangeOf(first.walk).capacity)
  {
    moveToEnd(first, needed);
  }
  rangeOf(first.walk).size = needed;
}

void WalkBlock::setSegment(const SegmentRef& place, const StoredSegment& segment)
{
  const std::size_t point = pointOf(place), hit = hitOf(place);
  setPoint(point, segment.begin);
  const unsigned tag = segment.isContact ? kContactTag : tagOf(segment.id.object);
  tags_[point] = static_cast<std::uint16_t>(
    (place.walk - firstWalk_) | (segment.isFront ? 0u : kBack) | tag << kTagShift);
  ids_[hit] = segment.id;
  weights_[hit] = segment.weights;
}

void WalkBlock::setEnd(std::uint32_t walk, const StoredPoint& end)
{
  const std::size_t point = pointOf({ walk, size(walk) });
  setPoint(point, end);
  tags_[point] = static_cast<std::uint16_t>(walk - firstWalk_);
}

void WalkBlock::moveToEnd(const SegmentRef& end, std::uint32_t capacity)
{
  const std::uint32_t kept = end.bounce;
  rangeOf(end.walk).size = kept;
  unused_ += rangeOf(end.walk).points();
  if (3 * std::size_t{ unused_ } > x_.size() + capacity)
  {
    closeHoles();
  }
  const Range moved{ static_cast<std::uint32_t>(x_.size()), static_cast<std::uint32_t>(ids_.size()),
    kept, capacity };
  resizePools(x_.size() + moved.points(), ids_.size() + capacity);
  copy(*this, rangeOf(end.walk), moved, kept);
  rangeOf(end.walk) = moved;
}

void WalkBlock::closeHoles()
{
  WalkBlock dense(firstWalk_, numberOfWalks(), static_cast<int>(storedBands_), frame_, power_);
  std::vector<std::uint32_t> sizes;
  for (const Range& range : places_)
  {
    sizes.push_back(range.size);
  }
  dense.makeRoom(sizes);
  for (std::size_t i = 0; i < places_.size(); ++i)
  {
    dense.copy(*this, places_[i], dense.places_[i], places_[i].size);
    dense.places_[i].size = places_[i].size;
  }
  dense.staticHits_.swap(staticHits_);
  *this = std::move(dense);
}

void WalkBlock::resizePools(std::size_t points, std::size_t hits)
{
  const auto resize = [](auto& pool, std::size_t size) {
    if (size > pool.capacity())
    {
      // Doubling might waste half of the memory.
      pool.reserve(pool.empty() ? size : size + size / 8);
    }
    pool.resize(size);
  };
  resize(x_, points);
  resize(y_, points);
  resize(z_, points);
  resize(tags_, points);
  resize(ids_, hits);
  resize(weights_, hits);
  resize(powers_, hits * storedBands_);
}

void WalkBlock::copy(
  const WalkBlock& from, const Range& source, const Range& target, std::uint32_t count)
{
  const auto copyPool = [](const auto& pool, auto& copied, std::size_t first, std::size_t to,
                          std::size_t number) {
    std::copy_n(pool.begin() + static_cast<std::ptrdiff_t>(first), number,
      copied.begin() + static_cast<std::ptrdiff_t>(to));
  };
  // A walk that grows has no end point yet, but room for one.
  const std::uint32_t points = std::min({ count + 1, source.points(), target.points() });
  copyPool(from.x_, x_, source.firstPoint, target.firstPoint, points);
  copyPool(from.y_, y_, source.firstPoint, target.firstPoint, points);
  copyPool(from.z_, z_, source.firstPoint, target.firstPoint, points);
  copyPool(from.tags_, tags_, source.firstPoint, target.firstPoint, points);
  copyPool(from.ids_, ids_, source.firstHit, target.firstHit, count);
  copyPool(from.weights_, weights_, source.firstHit, target.firstHit, count);
  copyPool(from.powers_, powers_, source.firstHit * storedBands_, target.firstHit * storedBands_,
    count * storedBands_);
}

std::optional<SegmentRef> WalkBlock::segmentAt(std::size_t point) const
{
  const std::uint32_t walk = firstWalk_ + (tags_[point] & kWalkMask);
  const Range& range = rangeOf(walk);
  // Places that a walk left when it moved are not in its range.
  const std::uint32_t bounce = static_cast<std::uint32_t>(point) - range.firstPoint;
  return bounce < range.size ? std::optional<SegmentRef>({ walk, bounce }) : std::nullopt;
}

const Hit* WalkBlock::hiddenStaticHit(const SegmentRef& segment) const
{
  const auto found = staticHits_.find(key(segment));
  return found == staticHits_.end() ? nullptr : &found->second;
}

void WalkBlock::updateStaticHit(
  const SegmentRef& segment, const Hit& old, const Hit& now, bool isCached)
{
  if (!now.id.isDynamic())
  {
    staticHits_.erase(key(segment));
  }
  else if (isCached && !old.id.isDynamic())
  {
    staticHits_[key(segment)] = old;
  }
}

std::size_t WalkBlock::bytes() const
{
  const auto held = [](const auto& pool) { return pool.capacity() * sizeof(pool[0]); };
  return sizeof(*this) + held(places_) + held(x_) + held(y_) + held(z_) + held(tags_) + held(ids_) +
    held(weights_) + held(powers_) +
    staticHits_.size() * (sizeof(decltype(staticHits_)::value_type) + 2 * sizeof(void*)) +
    staticHits_.bucket_count() * sizeof(void*);
}

}
