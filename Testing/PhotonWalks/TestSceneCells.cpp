// SPDX-License-Identifier: BSD-3-Clause
#include "Kit.h"
#include "Surfaces/SceneCells.h"

namespace irradiance::test
{
namespace
{

/// `cells` rectangles of 1 m x `length`.
SceneObject strip(int cells, double length)
{
  ObjectBuilder builder;
  builder.addQuad({ 0, 0, 0 }, { double(cells), 0, 0 }, { 0, length, 0 }, cells, 1, grey(0));
  return builder.build();
}

TEST(SceneCells, AreNumberedObjectByObject)
{
  const CellNumbers numbers({ strip(3, 1), { strip(1, 1), strip(2, 1) } });
  EXPECT_EQ(numbers.size(), 6u);
  EXPECT_EQ(numbers.sizeOf(2), 2u);
  EXPECT_EQ((numbers[{ 1, 0 }]), 3u);
  std::size_t next = 0;
  numbers.forEach([&](const SceneCell& cell) { EXPECT_EQ(numbers[cell], next++); });
  EXPECT_EQ(next, 6u);
}

/// Areas follow poses, points, materials, and which objects are there.
TEST(SceneCells, HaveTheAreasOfTheFrame)
{
  SceneObjects objects{ strip(2, 5), { strip(1, 3), strip(4, 7) } };
  SceneCells cells;
  const auto expectAreas = [&](double first, double second) {
    cells.update(objects, {});
    EXPECT_DOUBLE_EQ(cells.area({ 0, 1 }), 5);
    EXPECT_DOUBLE_EQ(cells.area({ 1, 0 }), first);
    EXPECT_DOUBLE_EQ(cells.area({ 2, cells.numbers().sizeOf(2) - 1 }), second);
  };
  expectAreas(3, 7);
  objects.dynamicObjects[0].worldFromObject.linear *= 2;
  expectAreas(12, 7);
  objects.dynamicObjects[1].isPresent = false;
  expectAreas(12, 0);
  objects.dynamicObjects[0].worldFromObject.translation = { 1, 2, 3 };
  expectAreas(12, 0);
  objects.dynamicObjects[1] = strip(6, 2);
  expectAreas(12, 2);
  EXPECT_EQ(cells.numbers().size(), 9u);
}

/// A measurement that is broken off leaves no areas of another frame behind.
TEST(SceneCells, AreMeasuredAgainAfterAnInterruption)
{
  SceneObjects objects{ strip(2, 5), { strip(1, 3) } };
  SceneCells cells;
  cells.update(objects, {});
  objects.staticObject = strip(1 << 16, 4);
  int polls = 0;
  const CancelPoint stop = [&] { polls++ == 0 ? throw std::runtime_error("stop") : void(); };
  EXPECT_THROW(cells.update(objects, stop), std::runtime_error);
  objects.dynamicObjects[0] = strip(1, 8);
  cells.update(objects, stop);
  EXPECT_DOUBLE_EQ(cells.area({ 0, 9 }), 4);
  EXPECT_DOUBLE_EQ(cells.area({ 1, 0 }), 8);
}

// The parts of a scene whose cells gather direct light together: a motion of one leaves the others
// as they are.

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
    EXPECT_EQ(parts.front(), kStaticPart);
    std::uint32_t next = 1;
    for (std::size_t i = 1; i < parts.size(); ++i)
    {
      EXPECT_EQ(parts[i].first, next);
      EXPECT_GT(parts[i].second, parts[i].first);
      next = parts[i].second;
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
