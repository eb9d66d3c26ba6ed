// SPDX-License-Identifier: BSD-3-Clause
// Gathered light alone; TestNearLamps.cpp has what holds for shot light as well.

#include "Kit.h"
#include "LambertContour.h"

namespace irradiance::test
{
namespace
{

EngineSettings gathering(std::uint64_t seed, std::uint32_t walks)
{
  return Shoot(walks).seeded(seed).unverified().gathered();
}

/// Calls use(engine) for seeds 1 to `seeds`.
template <class Use>
void overSeeds(const SceneObjects& objects, int seeds, std::uint32_t walks, const Use& use)
{
  for (int seed = 1; seed <= seeds; ++seed)
  {
    UpdatedEngine engine(objects, gathering(static_cast<std::uint64_t>(seed), walks));
    const PowerBalance& balance = engine.balance();
    Power rest = balance.emitted;
    rest -= balance.absorbed;
    rest -= balance.escaped;
    ASSERT_TRUE(rest.isZero()) << "seed " << seed;
    use(engine);
  }
}

/// |t| > 3.5 of 63 degrees of freedom or more: by chance in less than .1 % of the comparisons.
void expectMean(const ReplicateMean& estimate, double truth, double within, const char* name)
{
  // Lights and cells are clear of surfaces by 2^-33 of the coordinates.
  EXPECT_TRUE(std::abs(estimate.t(truth)) <= 3.5 || std::abs(estimate.mean() / truth - 1) < 1e-7)
    << name;
  if (!kIsSanitized)
  {
    EXPECT_NEAR(estimate.mean(), truth, within * truth) << name;
  }
}

constexpr int kGatherSeeds = kIsSanitized ? 64 : 2048;

// Lambert's formula for a cell of 1 mm across and along a lamp of 1 x 1 m, 1 m (C-11's distance)
// and .1 m away. Two samples of each seed are all there are for so small a cell.
TEST(DirectGather, ASmallCellBesideALargeLamp)
{
  const std::vector<Vector3> lamp{ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
  const double size = 1e-3;
  for (const double height : { 1.0, 0.1 })
  {
    ObjectBuilder room;
    room.addQuad(lamp[0], { 1, 0, 0 }, { 0, 1, 0 }, 1, 1, grey(0, 10));
    room.addQuad({ 0.3, 0.2, height }, { 0, size, 0 }, { size, 0, 0 }, 1, 1, grey(0)); // faces it
    room.addQuad({ 1.1, 0.2, height }, { 0, 0, size }, { 0, size, 0 }, 1, 1, grey(0)); // edge-on
    ReplicateMean facing, upright;
    overSeeds({ room.build(), {} }, kGatherSeeds, 1000, [&](const IrradianceEngine& engine) {
      facing.add(engine.irradiance({ { 0, 1 } }, 0));
      upright.add(engine.irradiance({ { 0, 2 } }, 0));
    });
    const double half = size / 2;
    expectMean(facing,
      10 * lambertIrradiance({ 0.3 + half, 0.2 + half, height }, { 0, 0, -1 }, lamp), 5e-3,
      "facing");
    expectMean(upright,
      10 * lambertIrradiance({ 1.1, 0.2 + half, height + half }, { -1, 0, 0 }, lamp), 5e-3,
      "upright");
  }
}

// Lights near to what may move are gathered, however near they are.
TEST(DirectGather, AllPowerArrivesOnAFloorThatMayMove)
{
  const Box walls = box({ 0, 0, 0 }, { 4, 4, 3 });
  for (const double height : { 0.05, 0.01 })
  {
    ObjectBuilder room, floor;
    for (const int side : { 0, 1, 2, 3, 5 })
    {
      room.addSide(walls, side, 6, grey(0), true);
    }
    floor.addSide(walls, 4, 6, grey(0), true);
    room.addQuad({ 1.5, 1.5, height }, { 0, 0.05, 0 }, { 0.05, 0, 0 }, 1, 1, grey(0, 1000));
    const SceneObjects objects{ room.build(), { floor.build() } };
    ReplicateMean received;
    overSeeds(objects, 64, scaled(100000), [&](const IrradianceEngine& engine) {
      EXPECT_EQ(engine.walks().sets().size(), 2u);
      received.add(wattsOn(engine, 0, 0, objects.staticObject.material->numberOfCells) +
        wattsOn(engine, 1, 0, 36));
    });
    expectMean(received, 2.5, 0.02, "lamp over the floor");
  }
}

}
}
