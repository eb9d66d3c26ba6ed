// SPDX-License-Identifier: BSD-3-Clause
#include "Photons/PhotonTree.h"

#include <utility>

namespace irradiance
{

namespace
{

/// Photons of a pack when it is built: there is room for some that come later.
constexpr std::size_t kUsual = 12;
/// So few are not cut, as they often all leave: a leaf of small triangles.
constexpr std::size_t kFew = 3 * kUsual;

/// The axis along which photons spread most, and how far.
template <class Iterator>
std::pair<std::size_t, float> widestAxis(Iterator begin, Iterator end)
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
  std::pair<std::size_t, float> widest{};
  for (std::size_t i = 0; i < 3; ++i)
  {
    if (upper[i] - lower[i] > widest.second)
    {
      widest = { i, upper[i] - lower[i] };
    }
  }
  return widest;
}

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

/// Makes room for `count` entries, and keeps what memory there is unless most of it were idle.
template <class Entry>
void clear(std::vector<Entry>& entries, std::size_t count)
{
  entries.clear();
  if (entries.capacity() > 2 * count)
  {
    entries = std::vector<Entry>(); // {} would keep the memory
  }
  entries.reserve(count);
}

}

std::vector<LeafPhoton> PhotonTree::photons() const
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

void PhotonTree::addTo(Photons& photons, const Node& end) const
{
  for (std::size_t i = 0; i < end.packs(); ++i)
  {
    const PhotonPack& pack = packs_[end.first() + i];
    for (unsigned lane = 0; lane < PhotonPack::kSize; ++lane)
    {
      if (pack.isUsed(lane))
      {
        photons.push_back(pack[lane]);
      }
    }
  }
}

PhotonTree::Place PhotonTree::endOf(const LeafPhoton& photon, Place place) const
{
  for (; !nodes_[place.node].isEnd(); ++place.depth)
  {
    const Node& node = nodes_[place.node];
    place.node = node.first() + (photon.position[node.axis()] < node.value ? 0 : 1);
  }
  return place;
}

template <class Prefetch>
std::vector<PhotonTree::Place> PhotonTree::endsOf(
  const Photons& photons, const Prefetch& prefetch) const
{
  // Several descents side by side: while one waits for its node, others go on.
  constexpr std::size_t kAtOnce = 8;
  std::vector<Place> ends(photons.size());
  for (std::size_t begin = 0; begin < photons.size(); begin += kAtOnce)
  {
    const std::size_t end = std::min(begin + kAtOnce, photons.size());
    for (std::size_t open = end - begin; open > 0;)
    {
      open = 0;
      for (std::size_t i = begin; i < end; ++i)
      {
        const Node& node = nodes_[ends[i].node];
        if (!node.isEnd())
        {
          const bool isRight = photons[i].position[node.axis()] >= node.value;
          ends[i] = { node.first() + (isRight ? 1 : 0), ends[i].depth + 1 };
          ++open;
        }
      }
    }
    for (std::size_t i = begin; i < end; ++i)
    {
      prefetch(packs_[nodes_[ends[i].node].first()]);
    }
  }
  return ends;
}

bool PhotonTree::change(const Photons& gone, const Photons& arrived)
{
  if (2 * std::max(gone.size(), arrived.size()) > size_)
  {
    // To cut packs one after the other takes longer and leaves them emptier.
    Photons all = photonsExcept(gone);
    const bool areFound = all.size() + gone.size() == size_;
    all.insert(all.end(), arrived.begin(), arrived.end());
    build(std::move(all));
    return areFound;
  }
  if (!remove(gone))
  {
    return false;
  }
  constexpr std::size_t kFewPacks = 4;
  const bool isTooDeep = insert(arrived) > kDeepest;
  if (isTooDeep || packs_.size() > kFewPacks + 2 * (size_ / kUsual))
  {
    build(photons());
  }
  return true;
}

PhotonTree::Photons PhotonTree::photonsExcept(const Photons& gone) const
{
  std::vector<SegmentRef> references;
  references.reserve(gone.size());
  for (const LeafPhoton& photon : gone)
  {
    references.push_back(photon.reference());
  }
  std::sort(references.begin(), references.end());
  Photons others = photons();
  others.erase(std::remove_if(others.begin(), others.end(),
                 [&](const LeafPhoton& photon) {
                   return std::binary_search(
                     references.begin(), references.end(), photon.reference());
                 }),
    others.end());
  return others;
}

int PhotonTree::insert(const Photons& photons)
{
  const std::vector<Place> ends = endsOf(photons, [](const PhotonPack& pack) { pack.prefetch(); });
  int deepest = 0;
  for (std::size_t i = 0; i < photons.size(); ++i)
  {
    // Others may have cut it since.
    const Place place = endOf(photons[i], ends[i]);
    deepest = std::max(deepest, place.depth + 1);
    const Node end = nodes_[place.node];
    if (!anyPack(end, [&](PhotonPack& pack) { return pack.add(photons[i]); }))
    {
      Photons crowd;
      crowd.reserve(end.packs() * PhotonPack::kSize + 1);
      addTo(crowd, end);
      crowd.push_back(photons[i]);
      std::size_t spare = end.first();
      build(place.node, crowd.begin(), crowd.end(), spare);
    }
  }
  size_ += photons.size();
  return deepest;
}

bool PhotonTree::remove(const Photons& photons)
{
  const std::vector<Place> ends =
    endsOf(photons, [](const PhotonPack& pack) { pack.prefetchForRemoval(); });
  for (std::size_t i = 0; i < photons.size(); ++i)
  {
    if (!anyPack(nodes_[ends[i].node],
          [&](PhotonPack& pack) { return pack.remove(photons[i].reference()); }))
    {
      return false;
    }
    --size_;
  }
  return true;
}

void PhotonTree::build(Photons photons)
{
  size_ = photons.size();
  const std::size_t packs = (size_ + kUsual - 1) / kUsual;
  clear(packs_, packs);
  clear(nodes_, 2 * packs);
  if (photons.empty())
  {
    return;
  }
  append(nodes_, 1);
  std::size_t spare = kNoPack;
  if (size_ <= kFew)
  {
    return makeEnd(0, photons.begin(), size_, spare);
  }
  build(0, photons.begin(), photons.end(), spare);
}

void PhotonTree::build(
  std::size_t node, Photons::iterator begin, Photons::iterator end, std::size_t& spare)
{
  const auto size = static_cast<std::size_t>(end - begin);
  const auto widest = widestAxis(begin, end);
  const auto axis = widest.first;
  if (size <= PhotonPack::kSize || widest.second == 0)
  {
    return makeEnd(node, begin, size, spare);
  }
  const std::size_t packs = (size + kUsual - 1) / kUsual;
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
  nodes_[node] = { plane, static_cast<std::uint32_t>(left << 2 | axis) };
  build(left, begin, middle, spare);
  build(left + 1, middle, end, spare);
}

void PhotonTree::makeEnd(
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
  nodes_[node] = { static_cast<float>(packs), static_cast<std::uint32_t>(first << 2 | Node::kEnd) };
}

}
