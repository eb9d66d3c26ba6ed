// SPDX-License-Identifier: BSD-3-Clause
#include "EngineRun.h"
#include "LambertContour.h"
#include "TestScenes.h"

#include <gtest/gtest.h>

namespace irradiance
{

namespace
{

using test::box;
using test::grey;
using test::ObjectBuilder;
using test::ReplicateMean;

EngineSettings gathering(std::uint64_t seed, std::uint32_t walks)
{
  EngineSettings settings;
  settings.numberOfWalks = walks;
  settings.seed = seed;
  settings.verify = false;
  settings.gathersDirectLight = true;
  return settings;
}

/// Calls use(engine) for seeds 1 to `seeds`.
template <class Use>
void overSeeds(const SceneObjects& objects, int seeds, std::uint32_t walks, const Use& use)
{
  for (int seed = 1; seed <= seeds; ++seed)
  {
    IrradianceEngine engine;
    Execution serial;
    engine.update(objects, gathering(static_cast<std::uint64_t>(seed), walks), serial);
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
  estimate.print(name, truth);
  // Lights and cells are clear of surfaces by 2^-33 of the coordinates.
  EXPECT_TRUE(std::abs(estimate.t(truth)) <= 3.5 || std::abs(estimate.mean() / truth - 1) < 1e-7)
    << name;
  if (!test::kIsSanitized)
  {
    EXPECT_NEAR(estimate.mean(), truth, within * truth) << name;
  }
}

constexpr int kSeeds = test::kIsSanitized ? 64 : 16384;

}

// Lambert's formula for a cell of 1 mm across and along a lamp of 1 x 1 m, 1 m (C-11's distance) and .1 m
// away. Two samples of each seed are all there are for so small a cell.
TEST(GatheredLight, ASmallCellBesideALargeLamp)
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
    overSeeds({ room.build(), {} }, kSeeds, 1000, [&](const IrradianceEngine& engine) {
      facing.add(engine.irradiance({ { 0, 1 } }, 0));
      upright.add(engine.irradiance({ { 0, 2 } }, 0));
    });
    const double half = size / 2;
    expectMean(facing,
      10 * test::lambertIrradiance({ 0.3 + half, 0.2 + half, height }, { 0, 0, -1 }, lamp), 5e-3,
      "facing");
    expectMean(upright,
      10 * test::lambertIrradiance({ 1.1, 0.2 + half, height + half }, { -1, 0, 0 }, lamp), 5e-3,
      "upright");
  }
}

// All that lamps of any kind emit arrives in a closed black room, however near they are to a wall.
TEST(GatheredLight, AllPowerArrives)
{
  const struct
  {
    const char* name;
    void (*add)(ObjectBuilder&);
    double flux;
  } lamps[] = {
    { "panel",
      [](ObjectBuilder& room) {
        room.addQuad({ 1.5, 1.5, 2 }, { 0, 1, 0 }, { 1, 0, 0 }, 2, 2, grey(0, 10));
      },
      10 },
    { "lamp .05 m over the floor",
      [](ObjectBuilder& room) {
        room.addQuad({ 1.5, 1.5, 0.05 }, { 0, 0.05, 0 }, { 0.05, 0, 0 }, 1, 1, grey(0, 1000));
      },
      2.5 },
    { "lamp .01 m over the floor",
      [](ObjectBuilder& room) {
        room.addQuad({ 1.5, 1.5, 0.01 }, { 0, 0.05, 0 }, { 0.05, 0, 0 }, 1, 1, grey(0, 1000));
      },
      2.5 },
    { "strip along a wall",
      [](ObjectBuilder& room) {
        room.addQuad({ 0.05, 0.2, 1.5 }, { 0, 0, 0.02 }, { 0, 3.6, 0 }, 1, 1, grey(0, 100));
      },
      7.2 },
    { "point light",
      [](ObjectBuilder& room) {
        room.addPointLight({ 1, 3, 0.5 }, 5);
      },
      5 },
    { "point light in a wall",
      [](ObjectBuilder& room) {
        room.addPointLight({ 1, 0, 0.5 }, 5);
      },
      5 },
    { "point light in a corner",
      [](ObjectBuilder& room) {
        room.addPointLight({ 0, 0, 3 }, 5);
      },
      5 },
    { "lamp in the plane of a wall",
      [](ObjectBuilder& room) {
        room.addQuad({ 1.5, 1.5, 3 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1, grey(0, 10));
      },
      10 },
  };
  for (const auto& [name, add, flux] : lamps)
  {
    ObjectBuilder room;
    room.addBox(box({ 0, 0, 0 }, { 4, 4, 3 }), 6, grey(0), true);
    add(room);
    const SceneObjects objects{ room.build(), {} };
    ReplicateMean received;
    overSeeds(objects, 64, test::scaled(100000), [&](const IrradianceEngine& engine) {
      received.add(test::wattsOn(engine, 0, 0, objects.staticObject.material->numberOfCells));
    });
    expectMean(received, flux, 0.02, name); // near lamps make much noise
  }
}

// Lights near to what may move are gathered, however near they are.
TEST(GatheredLight, AllPowerArrivesOnAFloorThatMayMove)
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
    overSeeds(objects, 64, test::scaled(100000), [&](const IrradianceEngine& engine) {
      EXPECT_EQ(engine.walks().sets().size(), 2u);
      received.add(test::wattsOn(engine, 0, 0, objects.staticObject.material->numberOfCells) +
        test::wattsOn(engine, 1, 0, 36));
    });
    expectMean(received, 2.5, 0.02, "lamp over the floor");
  }
}

// E = M / (1 - rho) in every cell: a lamp of the whole inside of a box, that reflects its own light.
TEST(GatheredLight, InAClosedBodyLightStaysInside)
{
  ObjectBuilder room, body;
  room.addBox(box({ -3, -3, -3 }, { 3, 3, 3 }), 3, grey(0.5), true);
  body.addBox(box({ -0.5, -0.5, -0.5 }, { 0.5, 0.5, 0.5 }), 2, grey(0.6, 1), true);
  const SceneObjects objects{ room.build(), { body.build() } };
  std::vector<ReplicateMean> cells(24);
  overSeeds(objects, 64, test::scaled(30000), [&](const IrradianceEngine& engine) {
    EXPECT_EQ(test::wattsOn(engine, 0, 0, 54), 0);
    for (std::size_t cell = 0; cell < cells.size(); ++cell)
    {
      cells[cell].add(engine.irradiance({ { 1, cell } }, 0));
    }
  });
  for (const ReplicateMean& cell : cells)
  {
    expectMean(cell, 1 / 0.4, 0.02, "inside");
  }
}

}
