// SPDX-License-Identifier: BSD-3-Clause
#include "Photons/LeafPhotons.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace irradiance
{

/**
 * Binds photons in two passes. In the first, units of walks or of changes find the leaves of their
 * photons, and sort these by parts of the trees; in the second, parts take their photons from all
 * units. So threads share neither leaves nor lists, and a part fits a cache.
 */
class LeafPhotons::Binding
{
public:
  explicit Binding(std::vector<Tree>& trees)
    : trees_(trees)
  {
    for (const Tree& tree : trees)
    {
      firstLeaf_.push_back(leaves_);
      leaves_ += tree.leaves.size();
    }
  }

  /// chosen(object): whether the photons of an object are looked at.
  template <class Chosen>
  void addBlocks(
    const WalkHistory& history, std::size_t first, std::size_t end, const Chosen& chosen)
  {
    constexpr std::size_t kPerUnit = 4; // blocks
    for (std::size_t begin = first; begin < end; begin += kPerUnit)
    {
      const auto addPhotons = [=, &history](List& list) {
        for (std::size_t block = begin; block < std::min(begin + kPerUnit, end); ++block)
        {
          history.forEachPhoton(block, [&](const Photon& photon) {
            if (chosen(photon.id.object))
            {
              list.push_back(bound(photon));
            }
          });
        }
      };
      units_.push_back({ false, addPhotons, {} });
    }
  }

  template <class Chosen>
  void addPhotons(bool areGone, const std::vector<Photon>& photons, const Chosen& chosen)
  {
    constexpr std::size_t kPerUnit = 8192; // photons
    for (std::size_t begin = 0; begin < photons.size(); begin += kPerUnit)
    {
      const auto addPhotons = [=, &photons](List& list) {
        list.reserve(kPerUnit);
        for (std::size_t i = begin; i < std::min(begin + kPerUnit, photons.size()); ++i)
        {
          if (chosen(photons[i].id.object))
          {
            list.push_back(bound(photons[i]));
          }
        }
      };
      units_.push_back({ areGone, addPhotons, {} });
    }
  }

  void run(Execution& execution)
  {
    ProgressSpan finding(execution, 0, 0.5), changing(execution, 0.5, 1);
    forEachSliced(units_.size(), finding, [&](std::size_t unit) { sort(units_[unit]); });
    forEachSliced(kParts, changing, [&](std::size_t part) { changePart(part); });
  }

private:
  static constexpr std::size_t kParts = 2048; ///< of all leaves, numbered through

  struct Bound
  {
    LeafPhoton photon;
    std::size_t leaf; ///< all leaves are numbered through
  };
  using List = std::vector<Bound>;
  struct Unit
  {
    bool areGone; ///< the photons leave, else they arrive
    std::function<void(List&)> addPhotons;
    List photons;                                  ///< by parts
    std::array<std::uint32_t, kParts + 1> begin{}; ///< of each part
  };

  Bound bound(const Photon& photon) const
  {
    const Tree& tree = trees_[photon.id.object];
    const UnitPoint at = unitPoint(
      tree.body->tree().frame(), modelPoint(tree.body->mesh(), photon.id.triangle, photon.weights));
    return { { at, photon.reference, photon.isFront, photon.id.triangle },
      firstLeaf_[photon.id.object] + tree.table.leafOf(tree.body->tree(), photon.id.triangle, at) };
  }

  void sort(Unit& unit) const
  {
    List list;
    unit.addPhotons(list);
    std::vector<std::uint16_t> parts;
    parts.reserve(list.size());
    for (const Bound& bound : list)
    {
      parts.push_back(static_cast<std::uint16_t>(bound.leaf * kParts / leaves_));
      ++unit.begin[parts.back() + std::size_t{ 1 }];
    }
    std::partial_sum(unit.begin.begin(), unit.begin.end(), unit.begin.begin());
    std::array<std::uint32_t, kParts + 1> next = unit.begin;
    unit.photons.resize(list.size());
    for (std::size_t i = 0; i < list.size(); ++i)
    {
      unit.photons[next[parts[i]]++] = list[i];
    }
  }

  /// What happens in one leaf.
  struct Step
  {
    std::size_t leaf;
    bool isGone;
    const LeafPhoton* photon;

    bool operator<(const Step& other) const { return leaf < other.leaf; }
  };

  void changePart(std::size_t part)
  {
    std::size_t size = 0;
    for (const Unit& unit : units_)
    {
      size += unit.begin[part + 1] - unit.begin[part];
    }
    std::vector<Step> steps;
    steps.reserve(size);
    for (const Unit& unit : units_)
    {
      for (std::uint32_t i = unit.begin[part]; i < unit.begin[part + 1]; ++i)
      {
        steps.push_back({ unit.photons[i].leaf, unit.areGone, &unit.photons[i].photon });
      }
    }
    std::sort(steps.begin(), steps.end());
    std::vector<LeafPhoton> gone, arrived;
    for (std::size_t i = 0; i < steps.size(); ++i)
    {
      (steps[i].isGone ? gone : arrived).push_back(*steps[i].photon);
      if (i + 1 == steps.size() || steps[i].leaf < steps[i + 1].leaf)
      {
        if (!leafAt(steps[i].leaf).change(gone, arrived))
        {
          throw std::logic_error("A photon that leaves is in no leaf");
        }
        gone.clear();
        arrived.clear();
      }
    }
  }

  PhotonTree& leafAt(std::size_t leaf)
  {
    const auto next = std::upper_bound(firstLeaf_.begin(), firstLeaf_.end(), leaf);
    const auto object = static_cast<std::size_t>(next - firstLeaf_.begin()) - 1;
    return trees_[object].leaves[leaf - firstLeaf_[object]];
  }

  std::vector<Tree>& trees_;
  std::vector<std::size_t> firstLeaf_; ///< of each object
  std::size_t leaves_ = 0;
  std::vector<Unit> units_;
};

LeafPhotons::LeafPhotons(const SceneObjects& objects)
{
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    trees_.emplace_back(objects[i].body);
  }
}

void LeafPhotons::add(
  const WalkHistory& history, std::size_t first, std::size_t end, Execution& execution)
{
  Binding binding(trees_);
  binding.addBlocks(history, first, end, [](std::uint32_t) { return true; });
  binding.run(execution);
}

void LeafPhotons::apply(const SceneObjects& objects, const WalkHistories& histories,
  const PhotonChanges& changes, Execution& execution)
{
  std::vector<std::size_t> gone(objects.size());
  for (const Photon& photon : changes.gone)
  {
    ++gone[photon.id.object];
  }
  std::vector<bool> isAnew, isEmptied;
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    isAnew.push_back(trees_[i].body != objects[i].body);
    // All photons on an object that moves leave.
    isEmptied.push_back(isAnew[i] || (gone[i] > 0 && gone[i] == trees_[i].size()));
    if (isAnew[i])
    {
      trees_[i] = Tree(objects[i].body);
    }
    else if (isEmptied[i])
    {
      std::for_each(
        trees_[i].leaves.begin(), trees_[i].leaves.end(), std::mem_fn(&PhotonTree::empty));
    }
  }
  const auto isNew = [&](std::uint32_t object) { return isAnew[object]; };
  const auto isOld = [&](std::uint32_t object) { return !isAnew[object]; };
  const auto isLeft = [&](std::uint32_t object) { return !isEmptied[object]; };
  Binding binding(trees_);
  if (std::find(isAnew.begin(), isAnew.end(), true) != isAnew.end())
  {
    for (const WalkHistory* history : histories)
    {
      binding.addBlocks(*history, 0, history->size(), isNew);
    }
  }
  binding.addPhotons(true, changes.gone, isLeft);
  binding.addPhotons(false, changes.arrived, isOld);
  binding.run(execution);
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    for (PhotonTree& leaf : trees_[i].leaves)
    {
      if (isEmptied[i] && leaf.size() == 0)
      {
        leaf = PhotonTree(); // gives its memory back
      }
    }
  }
}

std::size_t LeafPhotons::size() const
{
  return std::accumulate(trees_.begin(), trees_.end(), std::size_t{},
    [](std::size_t sum, const Tree& tree) { return sum + tree.size(); });
}

std::size_t LeafPhotons::bytes() const
{
  std::size_t bytes = 0;
  for (const Tree& tree : trees_)
  {
    bytes += tree.table.bytes() + tree.leaves.capacity() * sizeof(PhotonTree);
    for (const PhotonTree& leaf : tree.leaves)
    {
      bytes += leaf.bytes();
    }
  }
  return bytes;
}

}
