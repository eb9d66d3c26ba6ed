// SPDX-License-Identifier: BSD-3-Clause
#include "Photons/LeafPhotons.h"

#include "Execution/ProgressSpan.h"
#include "Execution/SlicedPass.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>
#include <tuple>

namespace irradiance
{

namespace
{

constexpr std::size_t kBlocksPerUnit = 4;     ///< of walks
constexpr std::size_t kChangesPerUnit = 4096; ///< photons
constexpr std::size_t kAhead = 8;             ///< photons between a request to memory and its use

std::size_t unitsOf(std::size_t count, std::size_t perUnit)
{
  return (count + perUnit - 1) / perUnit;
}

}

/**
 * Binds photons in two passes. In the first, units of walks or of changes find the leaves of their
 * photons, and sort these by parts of the trees; in the second, parts take their photons from all
 * units. So threads share neither leaves nor lists, and a part fits a cache.
 */
class LeafPhotons::Binding
{
public:
  Binding(std::vector<Tree>& trees, const SceneObjects& objects, const WalkHistory& history,
    const std::vector<bool>& isAnew)
    : trees_(trees)
    , objects_(objects)
    , history_(history)
    , isAnew_(isAnew)
  {
    for (const Tree& tree : trees)
    {
      firstLeaf_.push_back(leaves_);
      leaves_ += tree.leaves.size();
    }
  }

  void run(const PhotonChanges& changes, Execution& execution)
  {
    const bool isAnyAnew = std::find(isAnew_.begin(), isAnew_.end(), true) != isAnew_.end();
    const std::size_t blocks = isAnyAnew ? unitsOf(history_.blocks().size(), kBlocksPerUnit) : 0;
    const std::size_t arrived = unitsOf(changes.arrived.size(), kChangesPerUnit);
    arrived_.resize(blocks + arrived);
    gone_.resize(unitsOf(changes.gone.size(), kChangesPerUnit));
    ProgressSpan first(execution, 0, 0.5), second(execution, 0.5, 1);
    SlicedPass find{ arrived_.size() + gone_.size(), {} };
    find.work = [&](std::size_t unit, const Deadline&) {
      if (unit < blocks)
      {
        arrived_[unit] = sorted(photonsOf(unit));
      }
      else if (unit < arrived_.size())
      {
        arrived_[unit] = sorted(photonsOf(changes.arrived, unit - blocks, true));
      }
      else
      {
        gone_[unit - arrived_.size()] =
          sorted(photonsOf(changes.gone, unit - arrived_.size(), false));
      }
      return true;
    };
    find.run(first);
    SlicedPass bind{ kParts, {} };
    bind.work = [&](std::size_t part, const Deadline&) {
      change(part);
      return true;
    };
    bind.run(second);
  }

private:
  static constexpr std::size_t kParts = 256; ///< of all leaves, numbered through

  struct Bound
  {
    LeafPhoton photon;
    std::uint32_t object, leaf;
  };
  using List = std::vector<Bound>;
  struct Sorted
  {
    List photons;
    std::array<std::uint32_t, kParts + 1> begin{}; ///< of each part
  };

  std::size_t partOf(const Bound& bound) const
  {
    return (firstLeaf_[bound.object] + bound.leaf) * kParts / leaves_;
  }

  Bound bound(const Photon& photon, bool isFront) const
  {
    const Tree& tree = trees_[photon.id.object];
    const RigidObject& body = *tree.body;
    const UnitPoint at = unitPoint(body.tree().frame(), modelPoint(body.mesh(), photon));
    return { { at, photon.reference, isFront, photon.id.triangle }, photon.id.object,
      tree.table.leafOf(body.tree(), photon.id.triangle, at) };
  }

  /// By the stored walk alone.
  bool isFront(const Photon& photon) const
  {
    const SceneObject& object = objects_[photon.id.object];
    const Triangle world =
      transformed(object.worldFromObject, object.body->mesh()[photon.id.triangle]);
    return history_.incoming(photon.reference).dot(world.areaVector()) <= 0;
  }

  /// Of some blocks, those on objects that are bound anew.
  List photonsOf(std::size_t unit) const
  {
    List list;
    const std::size_t end = std::min((unit + 1) * kBlocksPerUnit, history_.blocks().size());
    for (std::size_t block = unit * kBlocksPerUnit; block < end; ++block)
    {
      history_.forEachPhoton(block, [&](const Photon& photon) {
        if (isAnew_[photon.id.object])
        {
          list.push_back(bound(photon, isFront(photon)));
        }
      });
    }
    return list;
  }

  /// Of some changes, those on objects that are not. Only what is in the history has a known side.
  List photonsOf(const std::vector<Photon>& changes, std::size_t unit, bool areInHistory) const
  {
    List list;
    const std::size_t end = std::min((unit + 1) * kChangesPerUnit, changes.size());
    for (std::size_t i = unit * kChangesPerUnit; i < end; ++i)
    {
      if (areInHistory && i + 2 * kAhead < end)
      {
        history_.prefetchPlace(changes[i + 2 * kAhead].reference);
        history_.prefetchPoint(changes[i + kAhead].reference);
      }
      if (!isAnew_[changes[i].id.object])
      {
        list.push_back(bound(changes[i], !areInHistory || isFront(changes[i])));
      }
    }
    return list;
  }

  Sorted sorted(const List& list) const
  {
    Sorted sorted;
    std::vector<std::uint16_t> parts;
    parts.reserve(list.size());
    for (const Bound& bound : list)
    {
      parts.push_back(static_cast<std::uint16_t>(partOf(bound)));
      ++sorted.begin[parts.back() + 1u];
    }
    std::partial_sum(sorted.begin.begin(), sorted.begin.end(), sorted.begin.begin());
    std::array<std::uint32_t, kParts + 1> next = sorted.begin;
    sorted.photons.resize(list.size());
    for (std::size_t i = 0; i < list.size(); ++i)
    {
      sorted.photons[next[parts[i]]++] = list[i];
    }
    return sorted;
  }

  PhotonLeaf& leafOf(const Bound& bound) { return trees_[bound.object].leaves[bound.leaf]; }

  void change(std::size_t part)
  {
    const List gone = photonsOf(part, gone_);
    for (std::size_t i = 0; i < gone.size(); ++i)
    {
      prefetchAhead(gone, i);
      if (!leafOf(gone[i]).remove(gone[i].photon))
      {
        throw std::logic_error("A photon that left was in no leaf");
      }
    }
    insert(photonsOf(part, arrived_));
  }

  /// Those of a part, by leaves.
  List photonsOf(std::size_t part, const std::vector<Sorted>& units) const
  {
    List all;
    for (const Sorted& unit : units)
    {
      all.insert(all.end(), unit.photons.begin() + unit.begin[part],
        unit.photons.begin() + unit.begin[part + 1]);
    }
    std::sort(all.begin(), all.end(), [](const Bound& a, const Bound& b) {
      return std::tie(a.object, a.leaf) < std::tie(b.object, b.leaf);
    });
    return all;
  }

  void prefetchAhead(const List& list, std::size_t i)
  {
    if (i + kAhead < list.size())
    {
      leafOf(list[i + kAhead]).prefetch(list[i + kAhead].photon);
    }
  }

  void insert(const List& list)
  {
    std::vector<LeafPhoton> together;
    for (std::size_t i = 0; i < list.size(); ++i)
    {
      together.push_back(list[i].photon);
      const bool isLast = i + 1 == list.size() || &leafOf(list[i]) != &leafOf(list[i + 1]);
      if (isLast)
      {
        leafOf(list[i]).insert(together.data(), together.data() + together.size());
        together.clear();
      }
    }
  }

  std::vector<Tree>& trees_;
  const SceneObjects& objects_;
  const WalkHistory& history_;
  const std::vector<bool>& isAnew_;
  std::vector<std::size_t> firstLeaf_; ///< of each object
  std::size_t leaves_ = 0;
  std::vector<Sorted> arrived_, gone_;
};

void LeafPhotons::build(
  const SceneObjects& objects, const WalkHistory& history, Execution& execution)
{
  trees_.assign(objects.size(), {});
  update(objects, history, {}, execution);
}

void LeafPhotons::update(const SceneObjects& objects, const WalkHistory& history,
  const PhotonChanges& changes, Execution& execution)
{
  std::vector<bool> isAnew;
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    isAnew.push_back(trees_[i].body != objects[i].body);
    if (isAnew.back())
    {
      const TriangleTree& tree = objects[i].body->tree();
      trees_[i] = { objects[i].body, LeafTable(tree),
        std::vector<PhotonLeaf>(tree.numberOfBlocks()) };
    }
  }
  Binding(trees_, objects, history, isAnew).run(changes, execution);
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
