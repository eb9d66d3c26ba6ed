// SPDX-License-Identifier: BSD-3-Clause
#include "Photons/PhotonLeaf.h"

#include "Simd/Prefetch.h"

#include <algorithm>
#include <utility>

namespace irradiance
{

namespace
{

/// Photons of a pack when it is built: there is room for some that come later.
constexpr std::size_t kUsual = 12;

/// The axis along which photons spread most.
struct Extent
{
  std::size_t axis = 0;
  float width = 0;

  template <class Iterator>
  Extent(Iterator begin, Iterator end)
  {
    UnitPoint lower = begin->position, upper = lower;
    for (; begin != end; ++begin)
    {
      for (std::size_t i = 0; i < 3; ++i)
      {
        lower[i] = std::min(lower[i], begin->position[i]);
        upper[i] = std::max(upper[i], begin->position[i]);
      }
    }
    for (std::size_t i = 0; i < 3; ++i)
    {
      if (upper[i] - lower[i] > width)
      {
        width = upper[i] - lower[i];
        axis = i;
      }
    }
  }
};

/// Appends `count` entries. Doubling might waste half of the memory.
template <class Entry>
void append(std::vector<Entry>& entries, std::size_t count)
{
  const std::size_t size = entries.size() + count;
  if (size > entries.capacity())
  {
    entries.reserve(size + size / 8);
  }
  entries.resize(size);
}

}

std::vector<LeafPhoton> PhotonLeaf::photons() const
{
  Photons photons;
  photons.reserve(size_);
  for (const Node& node : nodes_)
  {
    if (node.isEnd())
    {
      addTo(photons, node);
    }
  }
  return photons;
}

void PhotonLeaf::addTo(Photons& photons, const Node& end) const
{
  for (std::size_t i = 0; i < end.packs(); ++i)
  {
    const PhotonPack& pack = packs_[end.firstPack() + i];
    for (unsigned lane = 0; lane < PhotonPack::kSize; ++lane)
    {
      if (pack.isUsed(lane))
      {
        photons.push_back(pack[lane]);
      }
    }
  }
}

PhotonLeaf::Place PhotonLeaf::endOf(const LeafPhoton& photon, Place place) const
{
  for (; !nodes_[place.node].isEnd(); ++place.depth)
  {
    const Node& node = nodes_[place.node];
    place.node = node.left() + (photon.position[node.axis()] < node.plane() ? 0 : 1);
  }
  return place;
}

std::vector<PhotonLeaf::Place> PhotonLeaf::endsOf(const Photons& photons) const
{
  std::vector<Place> ends;
  ends.reserve(photons.size());
  for (const LeafPhoton& photon : photons)
  {
    ends.push_back(endOf(photon, {}));
    const PhotonPack& pack = packs_[nodes_[ends.back().node].firstPack()];
    for (std::size_t offset = 0; offset < sizeof(PhotonPack); offset += alignof(PhotonPack))
    {
      prefetchLine(reinterpret_cast<const char*>(&pack) + offset);
    }
  }
  return ends;
}

void PhotonLeaf::insert(const Photons& photons)
{
  if (2 * photons.size() > size_)
  {
    // To cut packs one after the other takes longer and leaves them emptier.
    Photons all = this->photons();
    all.insert(all.end(), photons.begin(), photons.end());
    build(std::move(all));
    return;
  }
  const std::vector<Place> ends = endsOf(photons);
  int deepest = 0;
  for (std::size_t i = 0; i < photons.size(); ++i)
  {
    // Others may have cut it since.
    const Place end = endOf(photons[i], ends[i]);
    insertAt(end, photons[i]);
    deepest = std::max(deepest, end.depth + 1);
  }
  if (deepest >= kDeepest || isWasteful())
  {
    build(this->photons());
  }
}

void PhotonLeaf::insertAt(const Place& place, const LeafPhoton& photon)
{
  const Node end = nodes_[place.node];
  ++size_;
  for (std::size_t i = 0; i < end.packs(); ++i)
  {
    if (packs_[end.firstPack() + i].add(photon))
    {
      return;
    }
  }
  Photons crowd;
  crowd.reserve(end.packs() * PhotonPack::kSize + 1);
  addTo(crowd, end);
  crowd.push_back(photon);
  std::size_t spare = end.firstPack();
  build(place.node, crowd.begin(), crowd.end(), spare);
}

bool PhotonLeaf::remove(const Photons& photons)
{
  const std::size_t kept = size_ - photons.size();
  if (2 * photons.size() > size_)
  {
    std::vector<PhotonReference> gone;
    gone.reserve(photons.size());
    for (const LeafPhoton& photon : photons)
    {
      gone.push_back(photon.reference());
    }
    std::sort(gone.begin(), gone.end());
    Photons all = this->photons();
    all.erase(std::remove_if(all.begin(), all.end(),
                [&](const LeafPhoton& photon) {
                  return std::binary_search(gone.begin(), gone.end(), photon.reference());
                }),
      all.end());
    build(std::move(all));
    return size_ == kept;
  }
  const std::vector<Place> ends = endsOf(photons);
  for (std::size_t i = 0; i < photons.size(); ++i)
  {
    if (!removeAt(ends[i], photons[i]))
    {
      return false;
    }
  }
  if (isWasteful())
  {
    build(this->photons());
  }
  return true;
}

bool PhotonLeaf::removeAt(const Place& place, const LeafPhoton& photon)
{
  const Node& end = nodes_[place.node];
  for (std::size_t i = 0; i < end.packs(); ++i)
  {
    if (packs_[end.firstPack() + i].remove(photon.reference()))
    {
      --size_;
      return true;
    }
  }
  return false;
}

bool PhotonLeaf::isWasteful() const
{
  constexpr std::size_t kFew = 4;
  return packs_.size() > kFew + 2 * (size_ / kUsual);
}

void PhotonLeaf::build(Photons photons)
{
  *this = {};
  if (photons.empty())
  {
    return;
  }
  size_ = photons.size();
  const std::size_t packs = (size_ + kUsual - 1) / kUsual;
  packs_.reserve(packs);
  nodes_.reserve(2 * packs - 1);
  append(nodes_, 1);
  std::size_t spare = kNoPack;
  build(0, photons.begin(), photons.end(), spare);
}

void PhotonLeaf::build(
  std::size_t node, Photons::iterator begin, Photons::iterator end, std::size_t& spare)
{
  const auto size = static_cast<std::size_t>(end - begin);
  const Extent extent(begin, end);
  if (size <= PhotonPack::kSize || extent.width == 0)
  {
    return makeEnd(node, begin, size, spare);
  }
  const std::size_t axis = extent.axis, packs = (size + kUsual - 1) / kUsual;
  const auto byPlace = [axis](const LeafPhoton& a, const LeafPhoton& b) {
    return a.position[axis] < b.position[axis];
  };
  auto middle = begin + static_cast<std::ptrdiff_t>(size * (packs / 2) / packs);
  std::nth_element(begin, middle, end, byPlace);
  float plane = middle->position[axis];
  // What lies in the plane belongs to its right. If that were all, the plane is the next one.
  middle = std::partition(
    begin, middle, [&](const LeafPhoton& photon) { return photon.position[axis] < plane; });
  if (middle == begin)
  {
    middle = std::partition(
      begin, end, [&](const LeafPhoton& photon) { return photon.position[axis] <= plane; });
    plane = std::min_element(middle, end, byPlace)->position[axis];
  }
  const std::size_t left = nodes_.size();
  append(nodes_, 2);
  nodes_[node] = Node::inner(plane, axis, left);
  build(left, begin, middle, spare);
  build(left + 1, middle, end, spare);
}

void PhotonLeaf::makeEnd(
  std::size_t node, Photons::const_iterator begin, std::size_t size, std::size_t& spare)
{
  const std::size_t packs = (size + PhotonPack::kSize - 1) / PhotonPack::kSize;
  std::size_t first = packs == 1 ? std::exchange(spare, kNoPack) : kNoPack;
  if (first == kNoPack)
  {
    first = packs_.size();
    append(packs_, packs);
  }
  for (std::size_t i = 0; i < packs; ++i)
  {
    packs_[first + i] = {};
    for (; size > 0 && packs_[first + i].add(*begin); ++begin, --size)
    {
    }
  }
  nodes_[node] = Node::end(first, packs);
}

}
