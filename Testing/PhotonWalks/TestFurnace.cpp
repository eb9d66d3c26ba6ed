// SPDX-License-Identifier: BSD-3-Clause
// A furnace: every cell emits what it does not reflect, so E = 1 everywhere, however it is found
// and whatever cells reflect. A lobe that loses light at some angle, or whose light leaves with a
// distribution that is not reciprocal, changes it.

#include "Kit.h"

namespace irradiance::test
{
namespace
{

/// A row: how a furnace is computed.
struct Way
{
  const char* name;
  Shoot settings;
  int seeds;
  int bands = 1;
  bool isGlossy = false;
  /// Cells that share their photons, or what they read, err together.
  bool areCellsIndependent = true;
  bool isClosed = true; ///< no light escapes: where direct light is gathered it is estimated
  friend std::ostream& operator<<(std::ostream& out, const Way& way) { return out << way.name; }
};

std::vector<Way> ways()
{
  constexpr int kMany = kIsSanitized ? 20 : 100, kFew = 16;
  const std::uint32_t walks = scaled(8192) * (kIsSanitized ? 4 : 1);
  const Shoot shot(walks), gathered = Shoot(walks).gathered(), fine = Shoot(12000).finalGather(32);
  return { { "Shot", shot, kMany }, { "ShotOnGloss", shot, kMany, 1, true },
    { "ShotOnGlossInColour", shot, kMany, 3, true },
    { "Gathered", gathered, kMany, 1, false, true, false },
    { "GatheredOnGloss", gathered, kMany, 1, true, true, false },
    { "GatheredOnGlossInColour", gathered, kMany, 3, true, true, false },
    { "Spread", Shoot(shot).spread(150), kFew, 1, false, false },
    { "SpreadOfGathered", Shoot(gathered).spread(150), kFew, 3, true, false, false },
    { "SmallCells", fine, kFew, 1, false, false, false },
    { "SmallCellsOnGloss", fine, kFew, 1, true, false, false },
    { "SmallCellsOnGlossInColour", fine, kFew, 3, true, false, false },
    { "AllCells", Shoot(fine).everywhere(), kFew, 1, false, false, false },
    { "AllCellsUnbiased", Shoot(fine).everywhere().unbiased(), kFew, 1, true, false, false } };
}

constexpr int kCellsASide = 3;

/// A box and a ball stand in a room without touching each other or a wall.
SceneObjects furnaceScene(const Way& way)
{
  RandomVectors random(81);
  ObjectBuilder thing(way.bands), round(way.bands);
  thing.addBox(box({ -0.5, -0.3, -0.4 }, { 0.5, 0.3, 0.4 }), 2, {});
  round.addSphere({ 0, 0, 0 }, 0.6, 4, {});
  const auto at = [&](double x, double z) { return AffineMap{ random.rotation(), { x, 1.5, z } }; };
  return { furnace(plainRoom({ 4, 3, 5 }, kCellsASide, {}, way.bands), random, way.isGlossy),
    { furnace(thing, random, way.isGlossy, at(2.9, 1.5)),
      furnace(round, random, way.isGlossy, at(1.1, 3.5)) } };
}

/// One estimate of a band for each cell, wall and object.
class FurnaceEstimates
{
public:
  void add(const IrradianceEngine& engine, int band)
  {
    std::size_t cellIndex = 0, areaIndex = 0;
    for (std::uint32_t object = 0; object < engine.objects().size(); ++object)
    {
      const std::size_t count = engine.cells().numbers().sizeOf(object);
      const std::size_t group = object == 0 ? kCellsASide * kCellsASide : count;
      for (std::size_t first = 0; first < count; first += group)
      {
        double area = 0, watts = 0;
        for (std::size_t cell = first; cell < first + group; ++cell)
        {
          const double found = engine.irradiance({ { object, cell } }, band);
          const double ofCell = engine.cells().area({ object, cell });
          area += ofCell;
          watts += found * ofCell;
          at(cells_, cellIndex++).add(found);
        }
        at(areas_, areaIndex++).add(watts / area);
      }
    }
  }

  const std::vector<ReplicateMean>& areas() const { return areas_; }
  /// Chi-square of t, with the variance n / (n - 2) of Student's t, over the value that chance
  /// exceeds once in 10^4; cells are taken as independent, for which a tenth is added.
  double chiSquareBesideLimit() const
  {
    double chiSquare = 0;
    for (const ReplicateMean& cell : cells_)
    {
      chiSquare += cell.t(1) * cell.t(1);
    }
    const double freedom = cells_[0].count() - 1.0;
    return chiSquare * (freedom - 2) / freedom /
      (1.1 * chiSquareLimit(double(cells_.size()), 3.72));
  }

private:
  static ReplicateMean& at(std::vector<ReplicateMean>& all, std::size_t i)
  {
    all.resize(std::max(all.size(), i + 1));
    return all[i];
  }

  std::vector<ReplicateMean> cells_, areas_;
};

class Furnace : public testing::TestWithParam<Way>
{
};

// 8 areas a band: |t| > 3.5 of 99 degrees (5 of 15 or 19): a false alarm in .6 % of all choices of
// seeds (.2 %).
TEST_P(Furnace, EveryCellReceivesOneWatt)
{
  const Way& way = GetParam();
  const SceneObjects objects = furnaceScene(way);
  std::vector<FurnaceEstimates> estimates(static_cast<std::size_t>(way.bands));
  IrradianceEngine engine;
  ThreadExecution two(2);
  for (int seed = 1; seed <= way.seeds; ++seed)
  {
    engine.update(objects, Shoot(way.settings).seeded(static_cast<std::uint64_t>(seed)), two);
    EXPECT_TRUE(!way.isClosed || engine.balance().escaped.isZero());
    for (int band = 0; band < way.bands; ++band)
    {
      estimates[static_cast<std::size_t>(band)].add(engine, band);
    }
  }
  EXPECT_EQ(
    engine.statistics().followedPaths > 0, way.settings.cellEstimate == CellEstimate::Gathered);
  for (const FurnaceEstimates& found : estimates)
  {
    ASSERT_EQ(found.areas().size(), 8u);
    for (const ReplicateMean& area : found.areas())
    {
      EXPECT_LE(std::abs(area.t(1)), way.seeds > 20 ? 3.5 : 5) << area.mean();
      EXPECT_NEAR(area.mean(), 1, kIsSanitized ? 0.15 : 0.03);
    }
    EXPECT_LE(way.areCellsIndependent ? found.chiSquareBesideLimit() : 0, 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Furnace, testing::ValuesIn(ways()),
  [](const auto& info) { return std::string(info.param.name); });

}
}
