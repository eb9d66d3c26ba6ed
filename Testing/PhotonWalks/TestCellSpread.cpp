// SPDX-License-Identifier: BSD-3-Clause
// Sums of cells, spread over the cells around them: what is conserved, and what it depends on.

#include "Estimates/CellSpread.h"

#include "Kit.h"

namespace irradiance::test
{
namespace
{

/// Sums with something at random in each part, `times` 2^30 or so, and in no few cells nothing.
CellSums randomSums(
  const SceneObjects& objects, const WalkPlan& plan, unsigned seed, std::int64_t times = 1)
{
  RandomVectors random(seed);
  CellSums sums(objects, plan);
  forEachSum(sums, [&](const CellSide& side, int band, std::uint32_t k, std::size_t) {
    sums.set(side, band, k,
      times * static_cast<std::int64_t>(random.engine() % 3 * (random.engine() % (1u << 30))));
  });
  return sums;
}

/// The sums of all cells of an object, by band and replicate.
std::map<std::pair<int, std::uint32_t>, std::int64_t> totals(
  const CellSums& sums, std::uint32_t object)
{
  std::map<std::pair<int, std::uint32_t>, std::int64_t> totals;
  forEachSum(sums, [&](const CellSide& side, int band, std::uint32_t k, std::size_t) {
    totals[{ band, k }] += side.object == object ? sums.shot(side, band, k, 1) : 0;
  });
  return totals;
}

/// All sums of the first round.
std::vector<double> valuesOf(const CellSums& sums)
{
  std::vector<double> values;
  forEachSum(sums, [&](const CellSide& side, int band, std::uint32_t k, std::size_t) {
    values.push_back(sums.sum(side, band, k, 1));
  });
  return values;
}

constexpr double kPhoton = 1 << 24; // quanta

/// On the average of its object, a cell draws on `photons` photons.
CellSums spreadOf(const SceneObjects& objects, const CellSums& sums, double photons, int sides = 1)
{
  Execution execution;
  CellSpread spread(sides);
  spread.update(objects, sums, 1, photons, kPhoton, execution);
  return spread.spread(objects, sums, 1, execution);
}

/// A sheet of fine cells, one with fewer, and a body.
SceneObjects someObjects(int bands = 1)
{
  ObjectBuilder sheet(bands), coarse(bands), body(bands);
  sheet.addQuad({ 0, 0, 0 }, { 2, 0, 0 }, { 0, 1, 0 }, 20, 10, grey(0.5));
  coarse.addQuad({ 2, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 5, 10, grey(0.5));
  body.addSphere({ 0, 0, 2 }, 0.5, 10, grey(0.5));
  return { sheet.build(), { coarse.build(), body.build() } };
}

// Also where there are more quanta than a double can count.
TEST(CellSpread, ConservesThePowerOfEachObjectBandAndReplicate)
{
  for (const int sides : { 1, 2 })
  {
    for (const std::int64_t times : { 1, (1 << 18) - 1 })
    {
      const SceneObjects objects = someObjects(3);
      const CellSums sums = randomSums(objects, WalkPlan(1000, 1000, 4), 5, times);
      const CellSums spread = spreadOf(objects, sums, 5000.0 * double(times), sides);
      EXPECT_NE(valuesOf(sums), valuesOf(spread));
      const std::vector<double> values = valuesOf(spread);
      EXPECT_GE(*std::min_element(values.begin(), values.end()), 0);
      for (std::uint32_t object = 0; object < objects.size(); ++object)
      {
        EXPECT_EQ(totals(sums, object), totals(spread, object));
      }
    }
  }
}

// Two halves of a room, one lit, that meet at a crease, at a gap, or as two objects: no quantum
// goes to the other. In a plane it does.
TEST(CellSpread, DoesNotLeak)
{
  enum class Border
  {
    None,
    Crease,
    Gap,
    Object
  };
  for (const Border border : { Border::None, Border::Crease, Border::Gap, Border::Object })
  {
    ObjectBuilder lit, dark;
    lit.addQuad({ -1, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 10, 10, grey(0.5));
    const auto addDark = [&](ObjectBuilder& builder) {
      builder.addQuad({ border == Border::Gap ? 1e-9 : 0, 0, 0 },
        border == Border::Crease ? Vector3(0, 0, 1) : Vector3(1, 0, 0), { 0, 1, 0 }, 10, 10,
        grey(0.5));
    };
    addDark(border == Border::Object ? dark : lit);
    const SceneObjects objects{ lit.build(), { dark.build() } };
    CellSums sums(objects, WalkPlan(1000, 1000, 1));
    for (std::size_t cell = 0; cell < 100; ++cell)
    {
      sums.set({ 0, cell, 0 }, 0, 0, cell % 7 == 0 ? 1 << 30 : 0);
    }
    const CellSums spread = spreadOf(objects, sums, 2000);
    double onDark = 0;
    for (std::size_t cell = 0; cell < 100; ++cell)
    {
      onDark +=
        border == Border::Object ? spread.sum({ 1, cell }, 0) : spread.sum({ 0, 100 + cell }, 0);
      EXPECT_GT(spread.sum({ 0, cell }, 0), 0);
    }
    EXPECT_EQ(onDark > 0, border == Border::None);
  }
}

// The same cells in another order, under other numbers.
TEST(CellSpread, DoesNotDependOnTheOrderOfCells)
{
  RandomVectors random(4);
  const SceneObject sphere = ball({ 0, 0, 0 }, 1, 12);
  const std::size_t cells = sphere.material->numberOfCells;
  std::vector<std::uint32_t> order(cells);
  std::iota(order.begin(), order.end(), 0u);
  std::shuffle(order.begin(), order.end(), random.engine);
  ObjectBuilder builder;
  for (const std::uint32_t cell : order)
  {
    std::vector<Triangle> triangles;
    for (std::size_t i = 0; i < sphere.body->mesh().size(); ++i)
    {
      if (sphere.material->cellOfTriangle[i] == cell)
      {
        triangles.push_back(sphere.body->mesh()[i]);
      }
    }
    builder.addCell(triangles, grey(0.5));
  }
  const SceneObjects objects{ nothing(), { sphere } }, shuffled{ nothing(), { builder.build() } };
  const WalkPlan plan(1000, 1000, 1);
  const CellSums sums = randomSums(objects, plan, 6);
  CellSums other(shuffled, plan);
  for (std::size_t i = 0; i < cells; ++i)
  {
    other.set({ 1, i, 0 }, 0, 0, sums.shot({ { 1, order[i] } }, 0, 1));
  }
  const CellSums spread = spreadOf(objects, sums, 1000),
                 otherSpread = spreadOf(shuffled, other, 1000);
  for (std::size_t i = 0; i < cells; ++i)
  {
    EXPECT_EQ(otherSpread.sum({ 1, i }, 0), spread.sum({ 1, order[i] }, 0));
  }
}

// Rigid motion and mirrors change nothing, to the bit; nor do powers of two. A shear does, as other
// cells come closer.
TEST(CellSpread, IsThatOfTheShape)
{
  RandomVectors random(8);
  const Matrix3 shear = (Matrix3() << 1, 2.5, 0, 0, 1, 0, 0, 0, 0.7).finished();
  const auto valuesWith = [](const Matrix3& linear, const Vector3& translation) {
    SceneObjects objects = someObjects();
    for (SceneObject& object : objects.dynamicObjects)
    {
      object.worldFromObject = { linear, translation };
    }
    const CellSums sums = randomSums(objects, WalkPlan(1000, 1000, 2), 9);
    return valuesOf(spreadOf(objects, sums, 3000, 2));
  };
  for (const Matrix3& shape : { Matrix3(Matrix3::Identity()), Matrix3(1.3 * shear), shear })
  {
    const auto expected = valuesWith(shape, { 0, 0, 0 });
    for (int i = 0; i < 10; ++i)
    {
      Matrix3 rotation = random.rotation();
      rotation.row(0) *= i % 3 == 0 ? -1 : 1;
      EXPECT_EQ(valuesWith(rotation * shape, random.inCube()), expected);
      EXPECT_EQ(valuesWith(std::ldexp(1.0, i - 5) * shape, random.inCube()), expected);
    }
  }
  EXPECT_NE(valuesWith(shear, { 0, 0, 0 }), valuesWith(Matrix3::Identity(), { 0, 0, 0 }));
}

// Of unit variance per area, by brute force: the sum of W_ik^2 A_k / A_i over all k.
TEST(CellSpread, KnowsThePartOfAPhotonThatACellTakes)
{
  ObjectBuilder builder;
  builder.addQuad({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 8, 8, grey(0.5));
  builder.addQuad({ 1, 0, 0 }, { 2, 0, 0 }, { 0, 1, 0 }, 4, 8, grey(0.5));
  builder.addQuad({ 9, 0, 0 }, { 0.1, 0, 0 }, { 0, 0.1, 0 }, 1, 1, grey(0.5)); // alone
  builder.addQuad({ 11, 0, 0 }, { 5, 0, 0 }, { 0, 1, 0 }, 2, 1, grey(0.5));    // large
  const SceneObjects objects{ builder.build(), {} };
  const std::vector<double> areas = cellAreas(objects.staticObject);
  const WalkPlan plan(1000, 1000, 2);
  const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
  const double photons = 0.5 / area; // of one photon in all: the width is 0.5 m2
  std::vector<double> shares(areas.size(), 0.0);
  for (std::size_t k = 0; k < areas.size(); ++k)
  {
    CellSums sums(objects, plan);
    sums.set({ 0, k, 0 }, 0, 0, std::int64_t{ 1 } << 24); // a photon
    const CellSums spread = spreadOf(objects, sums, photons);
    for (std::size_t i = 0; i < areas.size(); ++i)
    {
      const double w = double(spread.sum({ 0, i }, 0)) / kPhoton;
      shares[i] += w * w * areas[k] / areas[i];
    }
  }
  CellSums sums(objects, plan);
  sums.set({ 0, 0, 0 }, 0, 0, std::int64_t{ 1 } << 24);
  CellSpread spread(1);
  Execution execution;
  spread.update(objects, sums, 1, photons, kPhoton, execution);
  double ratio = 0;
  const std::size_t small = 64 + 32;
  for (std::size_t i = 0; i < small; ++i)
  {
    EXPECT_LT(shares[i], 0.5);
    EXPECT_NEAR(spread.photonShare({ 0, i }) / shares[i], 1, 1.4) << "4 standard errors";
    ratio += spread.photonShare({ 0, i }) / shares[i] / double(small);
  }
  EXPECT_NEAR(ratio, 1, 0.25) << "some ten independent parts";
  for (std::size_t i = small; i < areas.size(); ++i)
  {
    EXPECT_EQ(spread.photonShare({ 0, i }), 1);
    EXPECT_NEAR(shares[i], 1, 1e-12);
  }
}

}
}
