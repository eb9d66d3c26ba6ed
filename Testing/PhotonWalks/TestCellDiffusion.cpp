// SPDX-License-Identifier: BSD-3-Clause
#include "Estimates/CellDiffusion.h"
#include "Estimates/CellNeighbours.h"
#include "Kit.h"

namespace irradiance::test
{
namespace
{

using Quanta = std::vector<std::int64_t>;

constexpr std::int64_t kMany = std::int64_t{ 1 } << 42;

/// What fields become by all steps.
std::vector<Quanta> diffused(const CellDiffusion& diffusion, std::vector<Quanta> fields)
{
  const auto count = static_cast<unsigned>(fields.size());
  const std::size_t nodes = fields[0].size();
  std::vector<double> quanta(nodes * count), before;
  for (std::size_t i = 0; i < quanta.size(); ++i)
  {
    quanta[diffusion.placeOf(i / count) * count + i % count] =
      static_cast<double>(fields[i % count][i / count]);
  }
  for (int step = 0; step < diffusion.steps(); ++step)
  {
    diffusion.step(step, count, quanta, before);
  }
  for (std::size_t i = 0; i < quanta.size(); ++i)
  {
    fields[i % count][i / count] =
      static_cast<std::int64_t>(quanta[diffusion.placeOf(i / count) * count + i % count]);
  }
  return fields;
}

/// A surface, and its diffusion for a width.
struct Surface
{
  explicit Surface(const SceneObject& object)
    : areas(cellAreas(object))
    , neighbours(cellNeighbours(object.body->mesh().triangles(), object.material->cellOfTriangle,
        object.material->numberOfCells, 0))
  {
  }

  Quanta spread(const Quanta& quanta, double width, int sides = 1) const
  {
    const CellDiffusion diffusion(areas, neighbours, sides, width);
    return diffused(diffusion, { quanta })[0];
  }

  std::vector<double> areas;
  std::vector<CellNeighbours> neighbours;
};

Surface grid(int n)
{
  ObjectBuilder builder;
  builder.addQuad({ 0, 0, 0 }, { double(n), 0, 0 }, { 0, double(n), 0 }, n, n, grey(0));
  return Surface(builder.build());
}

/// Rectangles of 1 to 1/500 m2, each with an edge in common with the next; some turned over.
SceneObject unevenGrid()
{
  RandomVectors random(3);
  ObjectBuilder builder;
  std::vector<double> x{ 0 }, y{ 0 };
  for (int i = 0; i < 30; ++i)
  {
    x.push_back(x.back() + random.powerOfTwo(-4.5, 0));
    y.push_back(y.back() + random.powerOfTwo(-4.5, 0));
  }
  for (std::size_t i = 0; i < 30; ++i)
  {
    for (std::size_t j = 0; j < 30; ++j)
    {
      const Vector3 a(x[i], y[j], 0), b(x[i + 1], y[j], 0), c(x[i + 1], y[j + 1], 0),
        d(x[i], y[j + 1], 0);
      random.engine() % 4 == 0 ? builder.addCell({ { a, c, b }, { a, d, c } }, grey(0))
                               : builder.addCell({ { a, b, c }, { a, c, d } }, grey(0));
    }
  }
  return builder.build();
}

std::int64_t total(const Quanta& quanta)
{
  return std::accumulate(quanta.begin(), quanta.end(), std::int64_t{ 0 });
}

// Each step adds 2 w to the variance along each axis, all steps (width + pi / 2) / (4 pi) for
// squares of 1 m2. The effective area of what a point became is the width, to within a fifth where
// steps are few.
TEST(CellDiffusion, FillsTheWidth)
{
  constexpr std::size_t kCells = 81, kMiddle = 40;
  const Surface surface = grid(static_cast<int>(kCells));
  for (const double width : { 1.2, 2.0, 3.0, 4.0, 10.0, 50.0 })
  {
    Quanta quanta(kCells * kCells, 0);
    quanta[quanta.size() / 2] = kMany;
    quanta = surface.spread(quanta, width);
    double variance = 0, squares = 0;
    for (std::size_t i = 0; i < quanta.size(); ++i)
    {
      const double x = double(i % kCells) - double(kMiddle),
                   part = double(quanta[i]) / double(kMany);
      variance += part * x * x;
      squares += part * part;
    }
    if (width > 3.5)
    {
      EXPECT_NEAR(variance / ((width + M_PI / 2) / (4 * M_PI)), 1, 1e-6) << width;
    }
    EXPECT_NEAR(1 / squares / width, 1, 0.2) << width;
  }
}

// Rounding makes the irradiance of cells differ by a quantum. All that can flow are such
// differences.
TEST(CellDiffusion, LeavesAUniformIrradianceAsItIs)
{
  const Surface surface(unevenGrid());
  for (const double width : { 0.01, 0.3, 100.0 })
  {
    Quanta quanta;
    for (const double area : surface.areas)
    {
      quanta.push_back(static_cast<std::int64_t>(area * double(kMany >> 4)));
    }
    const Quanta after = surface.spread(quanta, width);
    const int steps = CellDiffusion(surface.areas, surface.neighbours, 1, width).steps();
    for (std::size_t i = 0; i < quanta.size(); ++i)
    {
      EXPECT_LE(std::abs(after[i] - quanta[i]), 4 * steps) << i;
    }
  }
}

// Side by side or one by one, on each instruction set.
TEST(CellDiffusion, FieldsSideBySideAreThoseAlone)
{
  const Surface surface(unevenGrid());
  RandomVectors random(11);
  for (const double width : { 0.01, 0.3, 100.0 })
  {
    std::vector<Quanta> fields(CellDiffusion::kFields, Quanta(2 * surface.areas.size()));
    for (Quanta& quanta : fields)
    {
      std::generate(quanta.begin(), quanta.end(),
        [&] { return static_cast<std::int64_t>(random.engine() % 1000000) - 500000; });
    }
    const CellDiffusion diffusion(surface.areas, surface.neighbours, 2, width);
    ASSERT_GT(diffusion.steps(), 0);
    const std::vector<Quanta> together = diffused(diffusion, fields);
    for (const SimdLevel level : simdLevels())
    {
      const SimdLimit limit(level);
      EXPECT_EQ(diffused(diffusion, fields), together);
      for (std::size_t i = 0; i < fields.size(); ++i)
      {
        EXPECT_EQ(diffused(diffusion, { fields[i] })[0], together[i]);
      }
    }
  }
}

// Half a plane in light: in between, the irradiance falls from one to the other and never rises.
TEST(CellDiffusion, MakesNoNewExtremes)
{
  constexpr std::size_t kCells = 41;
  Quanta quanta(kCells * kCells, 0);
  for (std::size_t i = 0; i < quanta.size(); ++i)
  {
    quanta[i] = i % kCells < kCells / 2 ? kMany : 0;
  }
  const Quanta after = grid(kCells).spread(quanta, 30);
  for (std::size_t i = 0; i < kCells; ++i)
  {
    for (std::size_t j = 1; j < kCells; ++j)
    {
      EXPECT_LE(after[i * kCells + j], after[i * kCells + j - 1]);
    }
  }
}

TEST(CellDiffusion, LeavesCellsOfTheWidthAlone)
{
  const Surface surface = grid(9);
  Quanta quanta(81, 0);
  quanta[40] = kMany;
  EXPECT_EQ(surface.spread(quanta, 1), quanta);
  EXPECT_EQ(CellDiffusion(surface.areas, surface.neighbours, 1, 1).steps(), 0);
  EXPECT_NE(surface.spread(quanta, 1.01), quanta);
}

// What is lit from above stays above, whichever way the cells are turned.
TEST(CellDiffusion, KeepsToItsSideOfTheSurface)
{
  const SceneObject object = unevenGrid();
  const Surface surface(object);
  std::vector<std::size_t> above; // the nodes
  for (std::uint32_t cell = 0; cell < surface.areas.size(); ++cell)
  {
    const auto first = std::find(
      object.material->cellOfTriangle.begin(), object.material->cellOfTriangle.end(), cell);
    const auto triangle = static_cast<std::size_t>(first - object.material->cellOfTriangle.begin());
    above.push_back(2 * cell + (object.body->mesh()[triangle].areaVector()[2] > 0 ? 0 : 1));
  }
  Quanta quanta(2 * surface.areas.size(), 0);
  for (std::size_t i = 0; i < above.size(); i += 5)
  {
    quanta[above[i]] = kMany;
  }
  const Quanta after = surface.spread(quanta, 1, 2);
  std::int64_t sum = 0;
  for (const std::size_t node : above)
  {
    sum += after[node];
    EXPECT_GT(after[node], 0);
    EXPECT_EQ(after[node ^ 1], 0) << "below";
  }
  EXPECT_EQ(sum, total(quanta));
}

// The conductance of a sliver may be infinite, or not known.
TEST(CellDiffusion, TakesAnyConductance)
{
  const std::vector<CellNeighbours> neighbours{ { { 0, 1 }, false, HUGE_VAL },
    { { 1, 2 }, false, std::nan("") }, { { 2, 3 }, false, 0 } };
  const CellDiffusion diffusion({ 1, 1e-300, 1, 1 }, neighbours, 1, 100);
  std::vector<double> quanta(4), before;
  const Quanta first{ kMany, 5, 7, 9 }, then{ kMany + 3, 2, 7, 9 };
  for (std::size_t i = 0; i < 4; ++i)
  {
    quanta[diffusion.placeOf(i)] = static_cast<double>(first[i]);
  }
  diffusion.step(0, 1, quanta, before);
  for (std::size_t i = 0; i < 4; ++i)
  {
    EXPECT_EQ(quanta[diffusion.placeOf(i)], static_cast<double>(then[i]))
      << "3/4 of what is in the sliver";
  }
}

// Slivers, points and lines among the cells.
TEST(CellDiffusion, PassesCellsWithoutArea)
{
  ObjectBuilder builder;
  const Vector3 a(0, 0, 0), b(1, 0, 0), c(1, 1, 0), d(0, 1, 0);
  const double thin = std::ldexp(1.0, -400);
  builder.addCell({ { a, b, c } }, grey(0));
  builder.addCell({}, grey(0));
  builder.addCell({ { a, c, c } }, grey(0));
  builder.addCell({ { c, Vector3(2, 1 + thin, thin), b } }, grey(0));
  builder.addCell({ { a, Vector3(0, thin, 0), d } }, grey(0)); // no area at all
  builder.addCell({ { a, c, d } }, grey(0));
  builder.addCell({ { d, c, Vector3(0.5, 1 + 1e-12, 0) } }, grey(0)); // a sliver
  const Quanta quanta{ kMany, 17, 18, 0, 19, 0, 5 };
  const Quanta after = Surface(builder.build()).spread(quanta, 10);
  EXPECT_EQ(total(after), total(quanta));
  EXPECT_EQ(after[1], 17);
  EXPECT_EQ(after[2], 18);
  EXPECT_EQ(after[4], 19);
  EXPECT_GT(after[3], 0);
  EXPECT_GT(after[5], 0);
  EXPECT_GE(after[6], 0);
}

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
