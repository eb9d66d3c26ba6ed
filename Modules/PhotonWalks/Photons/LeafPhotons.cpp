// SPDX-License-Identifier: BSD-3-Clause
#include "Photons/LeafPhotons.h"

#include "Execution/ProgressSpan.h"
#include "Execution/SlicedPass.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace irradiance
{

LeafPhotons::Tree::Tree(std::shared_ptr<const RigidObject> itsBody)
  : body(std::move(itsBody))
  , table(body->tree())
  , leaves(body->tree().numberOfBlocks())
{
}

/**
 * Binds photons in two passes. In the first, units of walks or of changes find the leaves of their
 * photons, and sort these by parts of the trees; in the second, parts take their photons from all
 * units. So threads share neither leaves nor lists, and a part fits a cache.
 */
class LeafPhotons::Binding
{
public:
  enum class What
  {
    Arrive,
    Leave
  };

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
    What what, const WalkHistory& history, std::size_t first, std::size_t end, const Chosen& chosen)
  {
    constexpr std::size_t kPerUnit = 4; // blocks
    for (std::size_t begin = first; begin < end; begin += kPerUnit)
    {
      addUnit(what, [=, &history](List& list) {
        for (std::size_t block = begin; block < std::min(begin + kPerUnit, end); ++block)
        {
          history.forEachPhoton(block, [&](const Photon& photon) {
            if (chosen(photon.id.object))
            {
              list.push_back(bound(photon));
            }
          });
        }
      });
    }
  }

  template <class Chosen>
  void addPhotons(What what, const std::vector<Photon>& photons, const Chosen& chosen)
  {
    constexpr std::size_t kPerUnit = 4096; // photons
    for (std::size_t begin = 0; begin < photons.size(); begin += kPerUnit)
    {
      addUnit(what, [=, &photons](List& list) {
        list.reserve(kPerUnit);
        for (std::size_t i = begin; i < std::min(begin + kPerUnit, photons.size()); ++i)
        {
          if (chosen(photons[i].id.object))
          {
            list.push_back(bound(photons[i]));
          }
        }
      });
    }
  }

  void run(Execution& execution)
  {
    ProgressSpan finding(execution, 0, 0.5), changing(execution, 0.5, 1);
    SlicedPass find{ units_.size(), {} };
    find.work = [&](std::size_t unit, const Deadline&) {
      sort(units_[unit]);
      return true;
    };
    find.run(finding);
    SlicedPass change{ kParts, {} };
    change.work = [&](std::size_t part, const Deadline&) {
      forEachLeaf(
        photonsOf(part, What::Leave), [](PhotonLeaf& leaf, const std::vector<LeafPhoton>& photons) {
          if (!leaf.remove(photons))
          {
            throw std::logic_error("A photon that leaves is in no leaf");
          }
        });
      forEachLeaf(photonsOf(part, What::Arrive),
        [](PhotonLeaf& leaf, const std::vector<LeafPhoton>& photons) { leaf.insert(photons); });
      return true;
    };
    change.run(changing);
  }

private:
  static constexpr std::size_t kParts = 512; ///< of all leaves, numbered through

  struct Bound
  {
    LeafPhoton photon;
    std::uint32_t object, leaf;
  };
  using List = std::vector<Bound>;
  struct Unit
  {
    What what;
    std::function<void(List&)> addPhotons;
    List photons;                                  ///< by parts
    std::array<std::uint32_t, kParts + 1> begin{}; ///< of each part
  };

  void addUnit(What what, std::function<void(List&)> addPhotons)
  {
    units_.push_back({ what, std::move(addPhotons), {} });
  }

  std::size_t partOf(const Bound& bound) const
  {
    return (firstLeaf_[bound.object] + bound.leaf) * kParts / leaves_;
  }

  Bound bound(const Photon& photon) const
  {
    const Tree& tree = trees_[photon.id.object];
    const UnitPoint at = unitPoint(
      tree.body->tree().frame(), modelPoint(tree.body->mesh(), photon.id.triangle, photon.weights));
    return { { at, photon.reference, photon.isFront, photon.id.triangle }, photon.id.object,
      tree.table.leafOf(tree.body->tree(), photon.id.triangle, at) };
  }

  void sort(Unit& unit) const
  {
    List list;
    unit.addPhotons(list);
    std::vector<std::uint16_t> parts;
    parts.reserve(list.size());
    for (const Bound& bound : list)
    {
      parts.push_back(static_cast<std::uint16_t>(partOf(bound)));
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

  /// By leaves.
  List photonsOf(std::size_t part, What what) const
  {
    std::size_t size = 0;
    for (const Unit& unit : units_)
    {
      size += unit.what == what ? unit.begin[part + 1] - unit.begin[part] : 0;
    }
    List all;
    all.reserve(size);
    for (const Unit& unit : units_)
    {
      if (unit.what == what)
      {
        all.insert(all.end(), unit.photons.begin() + unit.begin[part],
          unit.photons.begin() + unit.begin[part + 1]);
      }
    }
    std::sort(all.begin(), all.end(), [](const Bound& a, const Bound& b) {
      return a.object != b.object ? a.object < b.object : a.leaf < b.leaf;
    });
    return all;
  }

  PhotonLeaf& leafOf(const Bound& bound) { return trees_[bound.object].leaves[bound.leaf]; }

  /// Calls visit(leaf, photons) for each leaf of a list.
  template <class Visit>
  void forEachLeaf(const List& list, const Visit& visit)
  {
    std::vector<LeafPhoton> together;
    for (std::size_t i = 0; i < list.size(); ++i)
    {
      together.push_back(list[i].photon);
      if (i + 1 == list.size() || &leafOf(list[i]) != &leafOf(list[i + 1]))
      {
        visit(leafOf(list[i]), together);
        together.clear();
      }
    }
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
  binding.addBlocks(Binding::What::Arrive, history, first, end, [](std::uint32_t) { return true; });
  binding.run(execution);
}

void LeafPhotons::remove(
  const WalkHistory& history, std::size_t first, std::size_t end, Execution& execution)
{
  Binding binding(trees_);
  binding.addBlocks(Binding::What::Leave, history, first, end, [](std::uint32_t) { return true; });
  binding.run(execution);
}

void LeafPhotons::apply(const SceneObjects& objects, const WalkHistory& history,
  const PhotonChanges& changes, Execution& execution)
{
  std::vector<bool> isAnew;
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    isAnew.push_back(trees_[i].body != objects[i].body);
    if (isAnew.back())
    {
      trees_[i] = Tree(objects[i].body);
    }
  }
  const auto isNew = [&](std::uint32_t object) { return isAnew[object]; };
  const auto isOld = [&](std::uint32_t object) { return !isAnew[object]; };
  Binding binding(trees_);
  if (std::find(isAnew.begin(), isAnew.end(), true) != isAnew.end())
  {
    binding.addBlocks(Binding::What::Arrive, history, 0, history.blocks().size(), isNew);
  }
  binding.addPhotons(Binding::What::Leave, changes.gone, isOld);
  binding.addPhotons(Binding::What::Arrive, changes.arrived, isOld);
  binding.run(execution);
}

bool LeafPhotons::isEmpty(std::uint32_t object) const
{
  const std::vector<PhotonLeaf>& leaves = trees_[object].leaves;
  return std::all_of(
    leaves.begin(), leaves.end(), [](const PhotonLeaf& leaf) { return leaf.size() == 0; });
}

std::size_t LeafPhotons::bytes() const
{
  std::size_t bytes = 0;
  for (const Tree& tree : trees_)
  {
    bytes += tree.table.bytes() + tree.leaves.capacity() * sizeof(PhotonLeaf);
    for (const PhotonLeaf& leaf : tree.leaves)
    {
      bytes += leaf.bytes();
    }
  }
  return bytes;
}

}
