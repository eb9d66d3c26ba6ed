// SPDX-License-Identifier: BSD-3-Clause
#include "Kit.h"
#include "Photons/LeafPhotons.h"

// Leaves that are kept up to date have the same photons as leaves that are filled again.

namespace irradiance::test
{
namespace
{

LeafPhotons filled(const SceneObjects& objects, const WalkHistory& history, Execution& execution)
{
  LeafPhotons leaves(objects);
  leaves.add(history, 0, history.size(), execution);
  return leaves;
}

/// What a leaf holds, in order.
using Content = std::vector<std::tuple<UnitPoint, std::uint32_t, std::uint32_t, std::uint32_t>>;

Content contentOf(const PhotonTree& leaf)
{
  Content content;
  for (const LeafPhoton& photon : leaf.photons())
  {
    content.emplace_back(photon.position, photon.walk, photon.bounceAndSide, photon.triangle);
  }
  std::sort(content.begin(), content.end());
  return content;
}

/// Of all leaves of all objects.
std::vector<std::vector<Content>> contentsOf(const LeafPhotons& leaves, std::uint32_t objects)
{
  std::vector<std::vector<Content>> contents(objects);
  for (std::uint32_t object = 0; object < objects; ++object)
  {
    for (std::uint32_t leaf = 0; leaf < leaves.tree(object).numberOfBlocks(); ++leaf)
    {
      contents[object].push_back(contentOf(leaves.leaf(object, leaf)));
    }
  }
  return contents;
}

TEST(LeafPhotons, EachPhotonIsInALeafOfItsTriangle)
{
  const MovingScene scene(1, true, 43);
  const SceneObjects& objects = scene.objects();
  Execution execution;
  UpdatedEngine engine(objects, Shoot(4000).kept());
  const LeafPhotons leaves = filled(objects, onlySet(engine).history(), execution);
  std::set<SegmentRef> found;
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    const TriangleTree& tree = leaves.tree(object);
    bool isEmpty = true;
    for (std::uint32_t leaf = 0; leaf < tree.numberOfBlocks(); ++leaf)
    {
      for (const LeafPhoton& photon : leaves.leaf(object, leaf).photons())
      {
        isEmpty = false;
        const WalkHistory& history = onlySet(engine).history();
        const SegmentPlace place = history.placeOf(photon.reference());
        const Hit stored = history.hit(place);
        EXPECT_TRUE(found.insert(photon.reference()).second);
        EXPECT_EQ(stored.id, (TriangleId{ object, photon.triangle }));
        EXPECT_EQ(history.block(place.block).isFront(place.slot), photon.isFront());
        const TriangleMesh& mesh = objects[object].body->mesh();
        EXPECT_EQ(photon.position,
          unitPoint(tree.frame(), modelPoint(mesh, stored.id.triangle, stored.weights)));
        bool isListed = false;
        for (const TriangleBlock* block = tree.blocks() + leaf;; ++block)
        {
          for (unsigned lane = 0; lane < TriangleBlock::kSize; ++lane)
          {
            isListed = isListed || block->reference(lane) == photon.triangle;
          }
          if (block->isLast())
          {
            break;
          }
        }
        EXPECT_TRUE(isListed);
      }
    }
    EXPECT_EQ(leaves.isEmpty(object), isEmpty);
  }
  EXPECT_EQ(found.size(), photonsOf(onlySet(engine).history()).size());
  EXPECT_GT(found.size(), 4000u);
}

// The rest keep even their order.
TEST(LeafPhotons, OnlyTouchedLeavesChange)
{
  ObjectBuilder room = plainRoom({ 4, 4, 4 }, 12, grey(0.5));
  room.addQuad({ 1, 1, 3.75 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1, grey(0.5, 1));
  SceneObjects objects{ room.build(), { block({ 0.5, 2, 2 }, { 0.2, 0.2, 0.2 }, 1) } };
  Execution execution;
  UpdatedEngine engine(objects, Shoot(3000).kept());
  LeafPhotons leaves = filled(objects, onlySet(engine).history(), execution);
  const auto before = photonsOf(onlySet(engine).history());
  const auto ordersOf = [&] {
    std::vector<std::vector<SegmentRef>> orders;
    for (std::uint32_t object = 0; object < 2; ++object)
    {
      for (std::uint32_t leaf = 0; leaf < leaves.tree(object).numberOfBlocks(); ++leaf)
      {
        orders.emplace_back();
        for (const LeafPhoton& photon : leaves.leaf(object, leaf).photons())
        {
          orders.back().push_back(photon.reference());
        }
      }
    }
    return orders;
  };
  const auto old = ordersOf();
  objects.dynamicObjects[0].worldFromObject.translation[0] += 0.01;
  engine.update(objects, Shoot(3000).kept());
  const PhotonChanges changes = changesBetween(before, photonsOf(onlySet(engine).history()));
  leaves.apply(objects, { &onlySet(engine).history() }, changes, execution);
  std::set<SegmentRef> changed;
  for (const auto& photons : { changes.gone, changes.arrived })
  {
    std::for_each(photons.begin(), photons.end(),
      [&](const Photon& photon) { changed.insert(photon.reference); });
  }
  const auto now = ordersOf();
  int touched = 0, untouched = 0;
  for (std::size_t i = 0; i < now.size(); ++i)
  {
    const auto isChanged = [&](const SegmentRef& p) { return changed.count(p) > 0; };
    const bool isTouched = std::any_of(old[i].begin(), old[i].end(), isChanged) ||
      std::any_of(now[i].begin(), now[i].end(), isChanged);
    EXPECT_TRUE(isTouched || now[i] == old[i]) << "leaf " << i;
    isTouched ? ++touched : ++untouched;
  }
  EXPECT_GT(touched, 0);
  EXPECT_GT(untouched, 10);
}

TEST(LeafPhotons, BlocksComeAndGo)
{
  const MovingScene scene(1, true, 44);
  const SceneObjects& objects = scene.objects();
  Execution execution;
  UpdatedEngine engine(objects, Shoot(4000).kept());
  const WalkHistory& history = onlySet(engine).history();
  ASSERT_EQ(history.size(), 4u);
  LeafPhotons leaves(objects), half(objects);
  half.add(history, 0, 2, execution);
  leaves.add(history, 0, 2, execution);
  leaves.add(history, 2, 4, execution);
  EXPECT_EQ(contentsOf(leaves, objects.size()),
    contentsOf(filled(objects, history, execution), objects.size()));
  const std::vector<Photon> all = photonsOf(history);
  std::vector<Photon> first;
  std::copy_if(all.begin(), all.end(), std::back_inserter(first), [&](const Photon& photon) {
    return photon.reference.walk < onlySet(engine).plan().firstWalkOf(2);
  });
  leaves.apply(objects, { &history }, changesBetween(all, first), execution);
  EXPECT_EQ(contentsOf(leaves, objects.size()), contentsOf(half, objects.size()));
  leaves.apply(objects, { &history }, { first, {} }, execution);
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    EXPECT_TRUE(leaves.isEmpty(object));
  }
  EXPECT_THROW(leaves.apply(objects, { &history }, { first, {} }, execution), std::logic_error);
}

TEST(LeafPhotons, CanBeInterrupted)
{
  const MovingScene scene(1, true, 45);
  UpdatedEngine engine(scene.objects(), Shoot(2000).kept());
  StoppingExecution stopping(0);
  LeafPhotons leaves(scene.objects());
  EXPECT_THROW(leaves.add(onlySet(engine).history(), 0, onlySet(engine).history().size(), stopping),
    Interrupted);
}

}
}
