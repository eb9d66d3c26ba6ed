// SPDX-License-Identifier: BSD-3-Clause
#include "Rivals/CellPhotonSets.h"

#include "Simd/Prefetch.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace irradiance
{

CellPhotonSets::CellPhotonSets(const SceneObjects& objects)
  : objects_(objects.size())
{
  std::size_t sets = 0;
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    const std::shared_ptr<const Material>& material = objects[object].material;
    Cells cells{ material, sets, std::vector<std::uint32_t>(material->numberOfCells, kNone) };
    std::uint32_t count = 0;
    for (std::size_t cell = 0; cell < material->numberOfCells; ++cell)
    {
      if (material->isSpecular(cell))
      {
        cells.sets[cell] = count++;
      }
    }
    if (count > 0)
    {
      objects_[object] = std::move(cells);
      sets += count;
    }
  }
  sets_.resize(sets);
  while (sets >> partShift_ >= kParts)
  {
    ++partShift_;
  }
}

const PhotonSet* CellPhotonSets::setOf(const SceneCell& cell) const
{
  const Cells& cells = objects_[cell.object];
  return cells.material && cells.sets[cell.cell] != kNone
    ? &sets_[cells.firstSet + cells.sets[cell.cell]]
    : nullptr;
}

std::size_t CellPhotonSets::size(const SceneCell& cell) const
{
  const PhotonSet* const set = setOf(cell);
  return set ? set->size() : 0;
}

std::vector<SegmentRef> CellPhotonSets::sorted(const SceneCell& cell) const
{
  std::vector<SegmentRef> photons;
  if (const PhotonSet* const set = setOf(cell))
  {
    photons.reserve(set->size());
    set->forEach([&](const SegmentRef& photon) { photons.push_back(photon); });
    std::sort(photons.begin(), photons.end());
  }
  return photons;
}

std::size_t CellPhotonSets::bytes() const
{
  std::size_t bytes =
    sizeof(*this) + objects_.capacity() * sizeof(Cells) + sets_.capacity() * sizeof(PhotonSet);
  for (const Cells& cells : objects_)
  {
    bytes += cells.sets.capacity() * sizeof(std::uint32_t);
  }
  return std::accumulate(sets_.begin(), sets_.end(), bytes,
    [](std::size_t sum, const PhotonSet& set) { return sum + set.bytes(); });
}

/// Picks the photons on specular cells. Which they are is unpredictable, so they are picked without
/// branches, a few at a time, before they go to their parts.
class CellPhotonSets::Collector
{
public:
  Collector(CellPhotonSets& photons, Parts& parts)
    : photons_(photons)
    , parts_(parts)
  {
  }

  void add(const Photon& photon)
  {
    const Cells& cells = photons_.objects_[photon.id.object];
    if (!cells.material)
    {
      return;
    }
    const std::uint32_t set = cells.sets[cells.material->cellOfTriangle[photon.id.triangle]];
    sets_[count_] = cells.firstSet + set;
    references_[count_] = photon.reference;
    count_ += set != kNone ? 1 : 0;
    if (count_ == kMost)
    {
      flush();
    }
  }

  /// Has to be called at the end.
  void flush()
  {
    for (std::size_t i = 0; i < count_; ++i)
    {
      parts_[sets_[i] >> photons_.partShift_].push_back(
        { &photons_.sets_[sets_[i]], references_[i] });
    }
    count_ = 0;
  }

private:
  static constexpr std::size_t kMost = 512;

  CellPhotonSets& photons_;
  Parts& parts_;
  std::array<std::size_t, kMost> sets_{};
  std::array<SegmentRef, kMost> references_{};
  std::size_t count_ = 0;
};

std::vector<CellPhotonSets::Parts> CellPhotonSets::collect(const std::vector<Photon>& photons)
{
  std::vector<Parts> changes(1);
  Collector collector(*this, changes.front());
  for (const Photon& photon : photons)
  {
    collector.add(photon);
  }
  collector.flush();
  return changes;
}

std::vector<CellPhotonSets::Parts> CellPhotonSets::collect(
  const WalkHistory& history, std::size_t first, std::size_t end, Execution& execution)
{
  constexpr std::size_t kBlocksPerUnit = 16;
  std::vector<Parts> changes((end - first + kBlocksPerUnit - 1) / kBlocksPerUnit);
  forEachSliced(changes.size(), execution, [&](std::size_t unit) {
    const std::size_t begin = first + unit * kBlocksPerUnit;
    Collector collector(*this, changes[unit]);
    for (std::size_t block = begin; block < std::min(begin + kBlocksPerUnit, end); ++block)
    {
      history.forEachPhoton(block, [&](const Photon& photon) { collector.add(photon); });
    }
    collector.flush();
  });
  return changes;
}

/// Calls work(Change) for each change of a part, and prefetches what the later ones read.
template <class Work>
void CellPhotonSets::forEach(const std::vector<Parts>& changes, std::size_t part, const Work& work)
{
  constexpr std::size_t kAhead = 16;
  for (const Parts& parts : changes)
  {
    const std::vector<Change>& own = parts[part];
    for (std::size_t i = 0; i < own.size(); ++i)
    {
      prefetchLine(own[std::min(i + 2 * kAhead, own.size() - 1)].set);
      const Change& later = own[std::min(i + kAhead, own.size() - 1)];
      later.set->prefetch(later.photon);
      work(own[i]);
    }
  }
}

/// Makes room at once for all photons that a part is about to receive.
void CellPhotonSets::reserve(const std::vector<Parts>& changes, std::size_t part)
{
  const std::size_t first = part << partShift_;
  std::vector<std::size_t> sizes(std::size_t{ 1 } << partShift_, 0);
  for (const Parts& parts : changes)
  {
    for (const Change& change : parts[part])
    {
      ++sizes[static_cast<std::size_t>(change.set - sets_.data()) - first];
    }
  }
  for (std::size_t i = 0; i < sizes.size(); ++i)
  {
    if (sizes[i] > 0)
    {
      sets_[first + i].reserve(sets_[first + i].size() + sizes[i]);
    }
  }
}

void CellPhotonSets::insert(const std::vector<Parts>& changes, Execution& execution)
{
  forEachSliced(kParts, execution, [&](std::size_t part) {
    reserve(changes, part);
    forEach(changes, part, [](const Change& change) { change.set->insert(change.photon); });
  });
}

void CellPhotonSets::remove(const std::vector<Parts>& changes, Execution& execution)
{
  forEachSliced(kParts, execution, [&](std::size_t part) {
    forEach(changes, part, [](const Change& change) { change.set->remove(change.photon); });
  });
}

void CellPhotonSets::add(
  const WalkHistory& history, std::size_t first, std::size_t end, Execution& execution)
{
  if (!isEmpty())
  {
    ProgressSpan reading(execution, 0, 0.5), inserting(execution, 0.5, 1);
    insert(collect(history, first, end, reading), inserting);
  }
}

void CellPhotonSets::apply(const PhotonChanges& changes, Execution& execution)
{
  if (!isEmpty())
  {
    ProgressSpan removing(execution, 0, 0.5), inserting(execution, 0.5, 1);
    remove(collect(changes.gone), removing);
    insert(collect(changes.arrived), inserting);
  }
}

}
