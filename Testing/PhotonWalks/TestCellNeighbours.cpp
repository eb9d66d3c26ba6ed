// SPDX-License-Identifier: BSD-3-Clause

#include "Estimates/CellNeighbours.h"

#include "Kit.h"

namespace irradiance::test
{
namespace
{

std::vector<CellNeighbours> neighboursOf(const SceneObject& object, double normalLength = 0)
{
  return cellNeighbours(object.body->mesh().triangles(), object.material->cellOfTriangle,
    object.material->numberOfCells, normalLength);
}

/// Two cells with a common edge of 1 m, both 1 m high.
SceneObject foldedBy(double degrees, bool isTurned = false)
{
  const double angle = degrees * M_PI / 180;
  const Vector3 a(0, 0, 0), b(1, 0, 0), c(0.5, -1, 0), d(0.5, std::cos(angle), std::sin(angle));
  ObjectBuilder builder;
  builder.addCell({ { b, a, c } }, grey(0));
  builder.addCell({ isTurned ? Triangle{ b, a, d } : Triangle{ a, b, d } }, grey(0));
  return builder.build();
}

// The middles of squares and rectangles lie half a side behind each edge.
TEST(CellNeighbours, OfAGridOfRectangles)
{
  ObjectBuilder builder;
  builder.addQuad({ 0, 0, 0 }, { 6, 0, 0 }, { 0, 2, 0 }, 3, 2, grey(0)); // of 2 x 1
  std::map<std::array<std::uint32_t, 2>, double> found;
  for (const CellNeighbours& pair : neighboursOf(builder.build()))
  {
    EXPECT_FALSE(pair.isTurned);
    auto cells = pair.cells;
    std::sort(cells.begin(), cells.end());
    EXPECT_TRUE(found.emplace(cells, pair.conductance).second) << "listed once";
  }
  ASSERT_EQ(found.size(), 7u);
  for (const auto& [cells, conductance] : found)
  {
    EXPECT_NEAR(conductance, cells[1] - cells[0] == 1 ? 0.5 : 2.0, 1e-12);
  }
}

// The middle of a triangle lies a third of its height behind each edge.
TEST(CellNeighbours, EndAtCreasesAndKnowWhereFrontAndBackSwap)
{
  for (const double degrees : { 0.0, 20.0, 34.9, -34.9 })
  {
    for (const bool isTurned : { false, true })
    {
      const std::vector<CellNeighbours> pairs = neighboursOf(foldedBy(degrees, isTurned));
      ASSERT_EQ(pairs.size(), 1u) << degrees;
      EXPECT_EQ(pairs[0].isTurned, isTurned) << degrees;
      EXPECT_NEAR(pairs[0].conductance, 1 / (2.0 / 3), 1e-12) << degrees;
    }
  }
  for (const double degrees : { 35.1, -35.1, 90.0, -90.0, 179.0, 180.0 })
  {
    EXPECT_EQ(neighboursOf(foldedBy(degrees)).size(), 0u) << degrees;
    EXPECT_EQ(neighboursOf(foldedBy(degrees, true)).size(), 0u) << degrees;
  }
}

TEST(CellNeighbours, ShareExactlyTwoCorners)
{
  const auto count = [](const Vector3& corner) {
    ObjectBuilder builder;
    builder.addCell({ { { 1, 0, 0 }, { 1, -1, 0 }, { 2, 0, 0 } } }, grey(0));
    builder.addCell({ { corner, { 2, 0, 0 }, { 1, 1, 0 } } }, grey(0));
    return neighboursOf(builder.build()).size();
  };
  EXPECT_EQ(count({ 1, 0, 0 }), 1u);
  EXPECT_EQ(count({ 1, -0.0, -0.0 }), 1u);
  EXPECT_EQ(count({ 1, 0, 1e-300 }), 0u) << "a gap";
  EXPECT_EQ(count({ std::nextafter(1, 2), 0, 0 }), 0u) << "a gap";
  EXPECT_EQ(count({ 1.5, 0, 0 }), 0u) << "a corner on the edge of another";
}

TEST(CellNeighbours, AreTwoAtAnEdge)
{
  const Vector3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0), d(0, -1, 0);
  const auto count = [&](const std::vector<Triangle>& more) {
    ObjectBuilder builder;
    builder.addCell({ { a, b, c } }, grey(0));
    builder.addCell({ { b, a, d } }, grey(0));
    for (const Triangle& triangle : more)
    {
      builder.addCell({ triangle }, grey(0));
    }
    return neighboursOf(builder.build()).size();
  };
  EXPECT_EQ(count({}), 1u);
  EXPECT_EQ(count({ { a, b, { 0, 0, 1 } } }), 0u) << "a third";
  EXPECT_EQ(count({ { a, b, { 0.5, 0, 0 } }, { a, b, b }, { a, a, a } }), 1u)
    << "those without area are none";
}

// Two cells of three squares each, side by side.
TEST(CellNeighbours, AreListedForEachEdgeBetweenThem)
{
  const auto square = [](double x, double y) {
    const Vector3 a(x, y, 0), b(x + 1, y, 0), c(x + 1, y + 1, 0), d(x, y + 1, 0);
    return std::array<Triangle, 2>{ Triangle{ a, b, c }, Triangle{ a, c, d } };
  };
  std::array<std::vector<Triangle>, 2> cells;
  for (const auto& [cell, x, y] :
    { std::tuple(0, 0, 0), { 0, 1, 0 }, { 0, 2, 0 }, { 1, 0, 1 }, { 1, 1, 1 }, { 1, 2, 1 } })
  {
    for (const Triangle& triangle : square(x, y))
    {
      cells[static_cast<std::size_t>(cell)].push_back(triangle);
    }
  }
  ObjectBuilder builder;
  builder.addCell(cells[0], grey(0));
  builder.addCell(cells[1], grey(0));
  const std::vector<CellNeighbours> pairs = neighboursOf(builder.build());
  ASSERT_EQ(pairs.size(), 3u);
  for (const CellNeighbours& pair : pairs)
  {
    EXPECT_NEAR(pair.conductance, 1 / (2 * 0.5), 1e-12) << "the middles are 1/2 behind the edge";
  }
}

// On a prism with the chords h, folded by phi at each edge, the normal turns by sin(phi) / h for
// each metre across. With the normal length l all ways across are sqrt(1 + (l sin(phi) / h)^2)
// times as long.
TEST(CellNeighbours, KeepToWhereTheSurfaceFacesTheSameWay)
{
  constexpr int kSides = 40, kRows = 5;
  constexpr double kRadius = 0.3, kRow = 0.07, kNormalLength = 0.8;
  ObjectBuilder builder;
  builder.addGrid(kSides, kRows, grey(0), [&](int i, int j) {
    const double around = 2 * M_PI * (i % kSides) / kSides;
    return Vector3(kRadius * std::cos(around), kRadius * std::sin(around), kRow * j);
  });
  const double phi = 2 * M_PI / kSides, chord = 2 * kRadius * std::sin(phi / 2);
  const double stretch = std::hypot(1, kNormalLength * std::sin(phi) / chord);
  int around = 0, along = 0;
  for (const CellNeighbours& pair : neighboursOf(builder.build(), kNormalLength))
  {
    const bool isAlong = pair.cells[0] % kSides == pair.cells[1] % kSides;
    const double expected = isAlong ? chord * stretch / kRow : kRow / (chord * stretch);
    EXPECT_NEAR(pair.conductance / expected, 1, 1e-9);
    ++(isAlong ? along : around);
  }
  EXPECT_EQ(around, kSides * kRows);
  EXPECT_EQ(along, kSides * (kRows - 1));
}

}
}
