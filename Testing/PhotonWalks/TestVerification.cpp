// SPDX-License-Identifier: BSD-3-Clause
#include "Kit.h"

namespace irradiance::test
{
namespace
{

constexpr std::uint32_t kWalks = 4096;
constexpr double kFar = -20; ///< behind the emitter, out of the way

/**
 * A black tube along x, from an emitting end of 1 m2 at x = 0 to x = 10, and two black plates P and
 * Q that close it where they stand. All walks have one segment and the same power of 2^34 quanta,
 * so that cell sums count walks. This is Figure 4 of the paper with nothing left to chance.
 *
 *     |------P-------Q----|
 *     |      |       |    |
 *     |------|-------|----|
 */
class Tube
{
public:
  Tube(bool isClosed, bool cache)
  {
    const Box walls = box({ 0, 0, 0 }, { 10, 1, 1 });
    ObjectBuilder tube, plate;
    tube.addSide(walls, 0, 1, grey(0, 1), true);
    for (int side = isClosed ? 1 : 2; side < 6; ++side)
    {
      tube.addSide(walls, side, 10, grey(0), true);
    }
    plate.addQuad({ 0, -0.5, -0.5 }, { 0, 2, 0 }, { 0, 0, 2 }, 1, 1, grey(0));
    objects_ = { tube.build(), { plate.build(), plate.build() } };
    settings_.numberOfWalks = kWalks;
    settings_.cacheStaticHits = cache;
    move(0, kFar);
    move(1, kFar);
    alone_ = std::make_unique<Tube>(*this);
  }
  Tube(const Tube& other)
    : objects_(other.objects_)
    , settings_(other.settings_)
  {
    update();
  }

  void move(std::size_t plate, double x)
  {
    objects_.dynamicObjects[plate].worldFromObject = shift({ x, 0, 0 });
  }
  /// Moves a plate; returns the number of walks that were found invalid.
  std::int64_t movePlate(std::size_t plate, double x)
  {
    move(plate, x);
    update();
    EXPECT_EQ(engine_.statistics().repairedSegments, engine_.statistics().invalidWalks);
    EXPECT_TRUE(isAsFresh(engine_));
    return engine_.statistics().invalidWalks;
  }
  void update() { engine_.update(objects_, settings_); }

  std::int64_t onPlate(std::size_t plate) const
  {
    return engine_.sums().shot({ { static_cast<std::uint32_t>(plate + 1), 0 } }, 0, 1) >> 34;
  }
  std::int64_t escaped() const { return engine_.balance().escaped[0] >> 34; }
  /// Hits on the tube with x in (from, to); its end is at 10.
  std::int64_t between(double from, double to) const
  {
    const TriangleMesh& mesh = objects_.staticObject.body->mesh();
    std::int64_t quanta = 0;
    for (std::size_t i = 0; i < mesh.size(); i += 2) // two triangles a cell
    {
      const double x = mesh[i].bounds().center()[0];
      quanta += x > from && x < to ? engine_.sums().shot({ { 0, i / 2 } }, 0, 1) : 0;
    }
    return quanta >> 34;
  }
  /// The same tube with both plates out of the way.
  const Tube& alone() const { return *alone_; }

private:
  SceneObjects objects_;
  EngineSettings settings_;
  UpdatedEngine engine_;
  std::unique_ptr<Tube> alone_;
};

constexpr double kEnd = 11;

class Verification : public testing::TestWithParam<bool> // static-hit cache
{
};

// A plate moves. Where both plates stood, which moves where to, and from where on walks are found
// invalid; then which plate has these, and where those are that it let go.
TEST_P(Verification, WalksAreInvalidWhereAPlateCameOrWent)
{
  const struct
  {
    const char* name;
    double p, q;
    std::size_t plate;
    double to, invalidFrom, onP, onQ;
  } rows[] = { { "static hits stay where nothing came", kFar, kFar, 0, kFar - 5, kEnd, kEnd, kEnd },
    { "also behind all hits", kFar, kFar, 0, 12, kEnd, kEnd, kEnd },
    { "static hits are occluded", kFar, kFar, 0, 5, 5, 5, kEnd },
    { "hits stay when others move behind them", 5, kFar, 1, 8, kEnd, 5, kEnd },
    { "or from place to place", 5, 6, 1, 9, kEnd, 5, kEnd },
    { "or away", 5, 9, 1, kFar, kEnd, 5, kEnd },
    { "hits are occluded by another object", 7, kFar, 1, 4, 4, kEnd, 4 },
    { "the object that was hit comes closer", 7, kFar, 0, 3, 3, 3, kEnd },
    { "goes farther", 3, kFar, 0, 7, 3, 7, kEnd },
    { "static and dynamic hits are behind an object that went", 4, 8, 0, kFar, 4, kEnd, 8 } };
  for (const auto& row : rows)
  {
    SCOPED_TRACE(row.name);
    Tube tube(true, GetParam());
    tube.move(0, row.p);
    tube.move(1, row.q);
    tube.update();
    const Tube& alone = tube.alone();
    ASSERT_TRUE(row.invalidFrom == kEnd || alone.between(row.invalidFrom, kEnd) > 10);
    EXPECT_EQ(tube.movePlate(row.plate, row.to), alone.between(row.invalidFrom, kEnd));
    EXPECT_EQ(tube.onPlate(0), alone.between(row.onP, kEnd));
    EXPECT_EQ(tube.onPlate(1), alone.between(row.onQ, kEnd));
    const double first = std::min(row.onP, row.onQ);
    EXPECT_EQ(tube.between(-1, first), alone.between(-1, first));
    EXPECT_EQ(tube.between(first, kEnd), 0);
  }
}

TEST_P(Verification, NothingBehindAnObjectThatWent)
{
  Tube tube(false, GetParam());
  tube.move(0, 9);
  tube.update();
  EXPECT_EQ(tube.escaped(), 0);
  EXPECT_EQ(tube.movePlate(0, kFar), tube.alone().between(9, kEnd) + tube.alone().escaped());
  EXPECT_GT(tube.escaped(), 10);
  EXPECT_EQ(tube.escaped(), tube.alone().escaped());
  const std::int64_t escaped = tube.escaped();
  EXPECT_EQ(tube.movePlate(0, 9), tube.alone().between(9, kEnd) + escaped);
  EXPECT_EQ(tube.escaped(), 0);
}

// However little an object moves, the walks that hit it are shot again from that hit.
TEST_P(Verification, MotionOfAnUlpIsAMotion)
{
  Tube tube(true, GetParam());
  tube.move(0, 5);
  tube.update();
  EXPECT_EQ(tube.movePlate(0, 5), 0) << "not moved";
  const std::int64_t onPlate = tube.onPlate(0);
  EXPECT_EQ(tube.movePlate(0, std::nextafter(5, 6)), onPlate) << "moved by an ulp";
}

// A static hit is hidden, hidden nearer the lamp, hidden by another plate, and freed: section 3.3.
TEST_P(Verification, HiddenStaticHitsComeBack)
{
  Tube tube(true, GetParam());
  tube.update();
  const std::vector<std::int64_t> before = { tube.between(0, 3), tube.between(3, 6),
    tube.between(6, kEnd) };
  tube.movePlate(0, 6);
  tube.movePlate(0, 3);
  tube.movePlate(1, 1);
  tube.movePlate(0, 8);
  tube.movePlate(1, kFar);
  EXPECT_EQ(tube.onPlate(0), tube.alone().between(8, kEnd));
  tube.movePlate(0, kFar);
  EXPECT_EQ(
    (std::vector<std::int64_t>{ tube.between(0, 3), tube.between(3, 6), tube.between(6, kEnd) }),
    before);
}

INSTANTIATE_TEST_SUITE_P(StaticHitCache, Verification, testing::Bool(),
  [](const auto& cache) { return cache.param ? "On" : "Off"; });

}
}
