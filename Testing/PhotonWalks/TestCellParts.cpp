// SPDX-License-Identifier: BSD-3-Clause
// The parts of a scene whose cells gather direct light together: a motion of one leaves the others
// as they are.

#include "Kit.h"

namespace irradiance::test
{
namespace
{

/// Objects without triangles that have so many cells each.
SceneObjects objectsOf(std::size_t dynamic, std::size_t cells)
{
  SceneObjects objects;
  objects.staticObject.material = std::make_shared<Material>();
  auto material = std::make_shared<Material>();
  material->numberOfCells = cells;
  objects.dynamicObjects.resize(dynamic);
  for (SceneObject& object : objects.dynamicObjects)
  {
    object.material = material;
  }
  return objects;
}

SceneObjects roomWithBoxes(int count)
{
  ObjectBuilder room = plainRoom({ 4, 3, 3 }, 4, grey(0.5)), part;
  addPanel(room, { 1.5, 1, 2.9 }, 1, 1, 10);
  part.addBox(box({ -0.1, -0.1, 0 }, { 0.1, 0.1, 0.4 }), 2, grey(0.6));
  SceneObjects objects{ room.build(), {} };
  for (int i = 0; i < count; ++i)
  {
    objects.dynamicObjects.push_back(part.build(shift({ 0.5 + 0.5 * i, 1.5, 0.5 })));
  }
  return objects;
}

TEST(CellParts, HaveEachObjectOnce)
{
  for (const std::size_t dynamic : { 0, 1, 2, 7, 8, 9, 100, 1001 })
  {
    const std::vector<CellPart> parts = cellParts(objectsOf(dynamic, 10));
    EXPECT_EQ(parts.size(), 1 + std::min<std::size_t>(dynamic, 8)) << dynamic;
    EXPECT_EQ(parts.front(), (CellPart{ 0, 1 }));
    EXPECT_TRUE(parts.front().isStatic());
    std::uint32_t next = 1;
    for (std::size_t i = 1; i < parts.size(); ++i)
    {
      EXPECT_FALSE(parts[i].isStatic());
      EXPECT_EQ(parts[i].first, next);
      EXPECT_GT(parts[i].end, parts[i].first);
      next = parts[i].end;
    }
    EXPECT_EQ(next, dynamic + 1);
  }
}

TEST(CellParts, AreFewerWhereCellsAreMany)
{
  EXPECT_EQ(cellParts(objectsOf(8, 10000)).size(), 1u + 6);
  EXPECT_EQ(cellParts(objectsOf(8, 1000000)).size(), 1u + 1);
}

TEST(CellParts, GatherAnewWhenTheyMoveAlone)
{
  SceneObjects objects = roomWithBoxes(4);
  EngineSettings settings = Shoot(4000).gathered();
  UpdatedEngine engine(objects, settings);
  const auto gatheredOf = [&] {
    std::vector<const DirectGather*> all;
    for (const WalkSet& set : engine.walks().sets())
    {
      set.forEachGathered([&](const DirectGather& light) { all.push_back(&light); });
    }
    return all;
  };
  const std::vector<const DirectGather*> before = gatheredOf();
  ASSERT_EQ(before.size(), 5u);
  std::size_t hidden = 0;
  // Into the light of the next one, onto it, and out again; then the next one itself.
  for (const Vector3& to :
    { Vector3(1.45, 1.5, 1), Vector3(1.5, 1.5, 0.9), Vector3(3.5, 2.5, 0.5), Vector3(1, 1.5, 0.5) })
  {
    objects.dynamicObjects[1].worldFromObject = shift(to);
    engine.update(objects, settings);
    const std::vector<const DirectGather*> now = gatheredOf();
    for (const std::size_t set : { 0, 1, 3, 4 })
    {
      EXPECT_EQ(now[set], before[set]) << "set " << set;
    }
    EXPECT_TRUE(isShownAsFresh(engine));
    hidden += engine.statistics().invalidWalks > 0 ? 1 : 0;
  }
  EXPECT_GT(hidden, 0u);
}

}
}
