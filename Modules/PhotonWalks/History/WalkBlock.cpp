// SPDX-License-Identifier: BSD-3-Clause
#include "History/WalkBlock.h"

#include <algorithm>

namespace irradiance
{

WalkBlock::WalkBlock(
  std::uint32_t numberOfWalks, int bands, const UnitFrame& frame, const Power& photon)
  : frame_(frame)
  , places_(numberOfWalks)
  , photon_(photon)
  , storedBands_(bands > 1 ? static_cast<std::size_t>(bands) : 0)
{
}

Hit WalkBlock::hit(std::uint32_t walk, std::uint32_t bounce) const
{
  const std::size_t place = slot(walk, bounce);
  Hit hit;
  hit.id = ids_[place];
  hit.weights = weights_[place];
  return hit;
}

Power WalkBlock::power(std::uint32_t walk, std::uint32_t bounce) const
{
  if (storedBands_ == 0)
  {
    return photon_;
  }
  Power power;
  const std::size_t first = slot(walk, bounce) * storedBands_;
  std::copy_n(
    powers_.begin() + static_cast<std::ptrdiff_t>(first), storedBands_, power.quanta.begin());
  return power;
}

double WalkBlock::shortestLength(std::uint32_t walk, std::uint32_t bounce) const
{
  const Vector3 from = point(slot(walk, bounce)), to = point(slot(walk, bounce) + 1);
  const double largest = std::max(from.cwiseAbs().maxCoeff(), to.cwiseAbs().maxCoeff());
  return std::max(0.0, (to - from).norm() - 0x1p-20 * largest) / frame_.scale;
}

void WalkBlock::setPoint(std::size_t slot, const StoredPoint& point)
{
  x_[slot] = point[0];
  y_[slot] = point[1];
  z_[slot] = point[2];
}

void WalkBlock::setPower(std::uint32_t walk, std::uint32_t bounce, const Power& power)
{
  const std::size_t first = slot(walk, bounce) * storedBands_;
  std::copy_n(
    power.quanta.begin(), storedBands_, powers_.begin() + static_cast<std::ptrdiff_t>(first));
}

void WalkBlock::replaceTail(std::uint32_t walk, std::uint32_t bounce, std::uint32_t count)
{
  for (std::uint32_t i = bounce + 1; i < places_[walk].size && !staticHits_.empty(); ++i)
  {
    staticHits_.erase(key(walk, i));
  }
  const std::uint32_t size = bounce + count;
  if (size + 1 > places_[walk].capacity)
  {
    moveToEnd(walk, bounce, size + 1);
  }
  places_[walk].size = size;
}

void WalkBlock::setSegment(std::uint32_t walk, std::uint32_t bounce, const StoredSegment& segment)
{
  const std::size_t place = slot(walk, bounce);
  setPoint(place, segment.begin);
  const unsigned tag = segment.isContact ? kContactTag : tagOf(segment.id.object);
  tags_[place] =
    static_cast<std::uint16_t>(walk | (segment.isFront ? 0u : kBack) | tag << kTagShift);
  ids_[place] = segment.id;
  weights_[place] = segment.weights;
}

void WalkBlock::setEnd(std::uint32_t walk, const StoredPoint& end)
{
  const std::size_t place = slot(walk, places_[walk].size);
  setPoint(place, end);
  tags_[place] = static_cast<std::uint16_t>(walk);
}

void WalkBlock::moveToEnd(std::uint32_t walk, std::uint32_t kept, std::uint32_t capacity)
{
  places_[walk].size = kept;
  unused_ += places_[walk].capacity;
  if (3 * std::size_t{ unused_ } > x_.size() + capacity)
  {
    closeHoles();
  }
  const auto end = static_cast<std::uint32_t>(x_.size());
  resizePools(end + std::size_t{ capacity });
  copyPlaces(*this, places_[walk].first, end, kept);
  places_[walk] = { end, kept, capacity };
}

void WalkBlock::closeHoles()
{
  WalkBlock dense(numberOfWalks(), static_cast<int>(storedBands_), frame_, photon_);
  std::size_t total = 0;
  for (const Range& range : places_)
  {
    total += range.size + std::size_t{ 1 };
  }
  dense.resizePools(total);
  std::uint32_t next = 0;
  for (std::uint32_t walk = 0; walk < numberOfWalks(); ++walk)
  {
    // The walk that is being moved has no end point yet, but room for one.
    const std::uint32_t count = std::min(places_[walk].size + 1, places_[walk].capacity);
    dense.copyPlaces(*this, places_[walk].first, next, count);
    dense.places_[walk] = { next, places_[walk].size, places_[walk].size + 1 };
    next += places_[walk].size + 1;
  }
  dense.staticHits_.swap(staticHits_);
  *this = std::move(dense);
}

void WalkBlock::reserve(std::size_t points)
{
  x_.reserve(points);
  y_.reserve(points);
  z_.reserve(points);
  tags_.reserve(points);
  ids_.reserve(points);
  weights_.reserve(points);
  powers_.reserve(points * storedBands_);
}

void WalkBlock::resizePools(std::size_t size)
{
  if (size > x_.capacity())
  {
    // Doubling might waste half of the memory.
    reserve(x_.empty() ? size : size + size / 8);
  }
  x_.resize(size);
  y_.resize(size);
  z_.resize(size);
  tags_.resize(size);
  ids_.resize(size);
  weights_.resize(size);
  powers_.resize(size * storedBands_);
}

void WalkBlock::copyPlaces(
  const WalkBlock& from, std::uint32_t source, std::uint32_t target, std::uint32_t count)
{
  const auto copy = [](const auto& pool, auto& copied, std::size_t first, std::size_t to,
                      std::size_t number) {
    std::copy_n(pool.begin() + static_cast<std::ptrdiff_t>(first), number,
      copied.begin() + static_cast<std::ptrdiff_t>(to));
  };
  copy(from.x_, x_, source, target, count);
  copy(from.y_, y_, source, target, count);
  copy(from.z_, z_, source, target, count);
  copy(from.tags_, tags_, source, target, count);
  copy(from.ids_, ids_, source, target, count);
  copy(from.weights_, weights_, source, target, count);
  copy(from.powers_, powers_, source * storedBands_, target * storedBands_, count * storedBands_);
}

bool WalkBlock::segmentAt(std::size_t point, Place& place) const
{
  place.walk = tags_[point] & kWalkMask;
  const Range& range = places_[place.walk];
  // Places that a walk left when it moved are not in its range.
  place.bounce = static_cast<std::uint32_t>(point) - range.first;
  return place.bounce < range.size;
}

const Hit* WalkBlock::hiddenStaticHit(std::uint32_t walk, std::uint32_t bounce) const
{
  const auto found = staticHits_.find(key(walk, bounce));
  return found == staticHits_.end() ? nullptr : &found->second;
}

void WalkBlock::rememberStaticHit(std::uint32_t walk, std::uint32_t bounce, const Hit& hit)
{
  staticHits_[key(walk, bounce)] = hit;
}

void WalkBlock::forgetStaticHit(std::uint32_t walk, std::uint32_t bounce)
{
  staticHits_.erase(key(walk, bounce));
}

void WalkBlock::updateStaticHit(
  std::uint32_t walk, std::uint32_t bounce, const Hit& old, const Hit& now, bool isCached)
{
  if (!now.id.isDynamic())
  {
    forgetStaticHit(walk, bounce);
  }
  else if (isCached && !old.id.isDynamic())
  {
    rememberStaticHit(walk, bounce, old);
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
