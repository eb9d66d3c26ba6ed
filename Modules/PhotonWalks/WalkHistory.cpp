#include "WalkHistory.h"

#include <algorithm>

namespace irradiance
{

WalkBlock::WalkBlock(std::uint32_t numberOfWalks, int bands, bool withSides)
  : bands_(bands)
  , withSides_(withSides)
  , places_(numberOfWalks)
{
}

Power WalkBlock::power(std::uint32_t walk, std::uint32_t bounce) const
{
  Power power;
  const std::size_t first =
    (places_[walk].first + std::size_t{ bounce }) * static_cast<std::size_t>(bands_);
  for (int band = 0; band < bands_; ++band)
  {
    power[band] = powers_[first + static_cast<std::size_t>(band)];
  }
  return power;
}

void WalkBlock::replaceTail(std::uint32_t walk, std::uint32_t bounce, const WalkTrace& tail)
{
  for (std::uint32_t i = bounce + 1; i < places_[walk].size && !staticHits_.empty(); ++i)
  {
    staticHits_.erase(key(walk, i));
  }
  const std::uint32_t size = bounce + tail.size();
  if (size > places_[walk].capacity)
  {
    moveToEnd(walk, bounce, size);
  }
  Place& place = places_[walk];
  place.size = size;
  for (std::uint32_t i = 0; i < tail.size(); ++i)
  {
    const std::size_t slot = place.first + std::size_t{ bounce } + i;
    segments_[slot] = tail.segment(i);
    for (int band = 0; band < bands_; ++band)
    {
      powers_[slot * static_cast<std::size_t>(bands_) + static_cast<std::size_t>(band)] =
        tail.power(i)[band];
    }
    if (withSides_)
    {
      fronts_[slot] = tail.isFront(i);
    }
  }
}

void WalkBlock::moveToEnd(std::uint32_t walk, std::uint32_t kept, std::uint32_t capacity)
{
  places_[walk].size = kept;
  unused_ += places_[walk].capacity;
  if (3 * std::size_t{ unused_ } > segments_.size() + capacity)
  {
    closeHoles();
  }
  const auto end = static_cast<std::uint32_t>(segments_.size());
  resizePools(end + std::size_t{ capacity });
  copySegments(*this, places_[walk].first, end, kept);
  places_[walk] = { end, kept, capacity };
}

void WalkBlock::closeHoles()
{
  WalkBlock dense(numberOfWalks(), bands_, withSides_);
  std::size_t total = 0;
  for (const Place& place : places_)
  {
    total += place.size;
  }
  dense.resizePools(total);
  std::uint32_t next = 0;
  for (std::uint32_t walk = 0; walk < numberOfWalks(); ++walk)
  {
    dense.copySegments(*this, places_[walk].first, next, places_[walk].size);
    dense.places_[walk] = { next, places_[walk].size, places_[walk].size };
    next += places_[walk].size;
  }
  dense.staticHits_.swap(staticHits_);
  *this = std::move(dense);
}

void WalkBlock::resizePools(std::size_t size)
{
  if (size > segments_.capacity() && !segments_.empty())
  {
    const std::size_t capacity = size + size / 8; // doubling would waste half of the memory
    segments_.reserve(capacity);
    powers_.reserve(capacity * static_cast<std::size_t>(bands_));
    fronts_.reserve(withSides_ ? capacity : 0);
  }
  segments_.resize(size);
  powers_.resize(size * static_cast<std::size_t>(bands_));
  fronts_.resize(withSides_ ? size : 0);
}

void WalkBlock::copySegments(
  const WalkBlock& from, std::uint32_t source, std::uint32_t target, std::uint32_t count)
{
  const auto bands = static_cast<std::size_t>(bands_);
  std::copy_n(from.segments_.begin() + source, count, segments_.begin() + target);
  for (std::size_t i = 0; i < count * bands; ++i)
  {
    powers_[target * bands + i] = from.powers_[source * bands + i];
  }
  for (std::uint32_t i = 0; i < count && withSides_; ++i)
  {
    fronts_[target + i] = from.fronts_[source + i];
  }
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

std::size_t WalkBlock::bytes() const
{
  return sizeof(*this) + places_.capacity() * sizeof(Place) +
    segments_.capacity() * sizeof(WalkSegment) + powers_.capacity() * sizeof(std::int64_t) +
    fronts_.capacity() +
    staticHits_.size() * (sizeof(decltype(staticHits_)::value_type) + 2 * sizeof(void*)) +
    staticHits_.bucket_count() * sizeof(void*);
}

void WalkBlock::shrink()
{
  segments_.shrink_to_fit();
  powers_.shrink_to_fit();
  fronts_.shrink_to_fit();
}

}
