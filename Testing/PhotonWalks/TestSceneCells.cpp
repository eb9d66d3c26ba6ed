// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/SceneCells.h"

#include "Kit.h"

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

}
}
