// SPDX-License-Identifier: BSD-3-Clause
#include "DirectLight/LampChoice.h"
#include "FrontWorld.h"
#include "Kit.h"

namespace irradiance::test
{
namespace
{

SceneObjects onlyStatic(const ObjectBuilder& builder)
{
  return { builder.build(), {} };
}

struct Starts
{
  std::vector<Ray> rays;
  std::vector<Power> powers;

  Starts(const SceneObjects& objects, std::uint32_t walks, std::uint64_t seed = 1)
  {
    const FrontWorld world(objects, WalkPlan(walks, walks, 1), seed);
    WalkFront front;
    world.enter(front, 0, walks);
    world.stages().start(front);
    for (std::uint32_t walk = 0; walk < walks; ++walk)
    {
      rays.push_back(world.rayOf(front, walk));
      powers.push_back(world.stages().powerOf(walk));
    }
  }

  Power total() const
  {
    Power sum;
    for (const Power& power : powers)
    {
      sum += power;
    }
    return sum;
  }
};

TEST(LightTable, EveryWalkOfOneBandStartsWithTheSameQuanta)
{
  for (const double flux : { 1.0, 10000.0, 0.1, M_PI, 3e-20, 7e25 })
  {
    ObjectBuilder builder;
    builder.addPointLight({ 1, 2, 3 }, flux);
    builder.addPointLight({ 4, 2, 3 }, 0.3 * flux);
    for (const std::uint32_t walks : { 1u, 7u, 1000u, 12345u })
    {
      const LightTable table(onlyStatic(builder), walks);
      EXPECT_EQ(table.flux(), flux + 0.3 * flux);
      EXPECT_EQ(Starts(onlyStatic(builder), walks).total(),
        (Power{ { walks * table.quantaPerWalk(), 0, 0 } }));
    }
  }
}

TEST(LightTable, QuantaAreAPowerOfTwoAndLeaveRoomForSums)
{
  ObjectBuilder builder;
  builder.addPointLight({ 0, 0, 0 }, 1);
  for (const std::uint32_t walks : { 1u, 2u, 3u, 1000000u, 0xffffffffu })
  {
    const std::int64_t quanta = LightTable(onlyStatic(builder), walks).quantaPerWalk();
    EXPECT_EQ(quanta & (quanta - 1), 0) << walks;
    EXPECT_GT(2.0 * static_cast<double>(quanta) * walks, 0x1p46) << walks;
    EXPECT_LE(static_cast<double>(quanta) * walks, 0x1p46) << walks;
  }
}

// Fluxes 1, 2, 5 of 8 W and 2^13 walks: the samples are stratified, so the counts are exact.
TEST(LightTable, LightsAreChosenInProportionToFlux)
{
  ObjectBuilder builder;
  for (const double flux : { 1.0, 0.0, 2.0, 5.0 })
  {
    builder.addPointLight({ flux, 0, 0 }, flux);
  }
  const SceneObjects objects = onlyStatic(builder);
  const LightTable table(objects, 8192);
  ASSERT_EQ(table.lights().size(), 3u);
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
  {
    std::array<int, 6> counts{};
    for (const Ray& ray : Starts(objects, 8192, seed).rays)
    {
      ++counts[static_cast<std::size_t>(ray.origin[0])];
    }
    EXPECT_EQ(counts, (std::array<int, 6>{ 0, 1024, 2048, 0, 0, 5120 })) << "seed " << seed;
  }
}

TEST(LightTable, CellsEmitFromTheirFrontInTheirColour)
{
  ObjectBuilder builder(3);
  builder.addQuad({ 1, 1, 2 }, { 0, 2, 0 }, { 3, 0, 0 }, 2, 2, { {}, { 4, 2, 1 } }); // looks down
  builder.addQuad({ 1, 1, 5 }, { 3, 0, 0 }, { 0, 2, 0 }, 1, 1, grey(0.5));
  const SceneObjects objects{ nothing(3), { builder.build(shift({ 10, 0, 0 })) } };
  const LightTable table(objects, 1000);
  ASSERT_EQ(table.lights().size(), 8u);
  const Starts starts(objects, 1000, 3);
  for (const Ray& ray : starts.rays)
  {
    ASSERT_LT(ray.direction[2], 0);
    ASSERT_LT(ray.origin[2], 2);
    ASSERT_NEAR(ray.origin[2], 2, 1e-8);
    ASSERT_TRUE(ray.origin[0] > 11 && ray.origin[0] < 14);
    ASSERT_EQ(ray.start.object, 1u);
  }
  for (const Power& power : starts.powers)
  {
    ASSERT_NEAR(double(power[0]) / double(power[2]), 4, 1e-6);
    ASSERT_NEAR(double(power[1]) / double(power[2]), 2, 1e-6);
  }
  // 6 m2 of 4, 2, 1 W/m2; each band is rounded once.
  EXPECT_EQ(table.flux(), 42);
  const Power total = starts.total();
  for (int band = 0; band < 3; ++band)
  {
    EXPECT_NEAR(double(total[band]) / double(1000 * table.quantaPerWalk()), (24 >> band) / 42.0,
      0.5 / double(table.quantaPerWalk()));
  }
}

TEST(LightTable, TablesAreEqualWhenTheyStartTheSameWalks)
{
  ObjectBuilder builder;
  builder.addBox(box({ 0, 0, 0 }, { 1, 1, 1 }), 1, grey(0, 1));
  const SceneObject lamp = builder.build();
  const SceneObjects objects{ nothing(), { lamp } };
  SceneObjects moved = objects;
  moved.dynamicObjects[0].worldFromObject.translation[1] = 1e-9;
  EXPECT_TRUE(LightTable(objects, 100) == LightTable(objects, 100));
  EXPECT_FALSE(LightTable(objects, 100) == LightTable(objects, 200)) << "other quanta";
  EXPECT_FALSE(LightTable(objects, 100) == LightTable(moved, 100));
  EXPECT_TRUE(LightTable({ nothing(), {} }, 100).isEmpty());
}

/// A square of `edge` x `edge` lamps in the ceiling, of 1 to 10 W/m2, and a point light.
LightTable manyLights(int edge)
{
  ObjectBuilder room;
  for (int i = 0; i < edge * edge; ++i)
  {
    addPanel(room, { 0.1 * (i % edge), 0.1 * (i / edge), 3 }, 0.1, 0.1, 1 + i % 10);
  }
  room.addPointLight({ 1, 1, 1 }, 0.5);
  return LightTable({ room.build(), {} }, 1000);
}

CellShape cellAt(const Vector3& center, double radius)
{
  CellShape cell;
  cell.center = center;
  cell.radius = radius;
  cell.normal = Vector3(0, 0, 1);
  cell.area = radius * radius;
  return cell;
}

// Over evenly spaced samples each lamp is chosen as often as its probability says, and the
// probabilities of all lamps are 1 together: what makes the estimate unbiased.
TEST(LampTree, EachLampIsChosenAsOftenAsItsProbability)
{
  for (const int edge : { 1, 4, 20 })
  {
    const LightTable lights = manyLights(edge);
    const LampPieces lamps(lights);
    LampChoice choice(lamps);
    for (const Vector3& center : { Vector3(0.5, 0.5, 2.9), Vector3(1, 1, 0), Vector3(1, 1, 1) })
    {
      choice.weigh(cellAt(center, 0.05));
      constexpr int kSamples = 200000;
      std::map<std::uint32_t, std::pair<double, int>> chosen; // probability, count
      for (int i = 0; i < kSamples; ++i)
      {
        const WeightChoice one = choice.choose((i + 0.5) / kSamples);
        ASSERT_GE(one.rest, 0);
        ASSERT_LT(one.rest, 1);
        const auto known =
          chosen.emplace(static_cast<std::uint32_t>(one.place), std::pair(one.weight, 0)).first;
        ASSERT_EQ(known->second.first, one.weight);
        ++known->second.second;
      }
      for (const auto& [piece, counted] : chosen)
      {
        EXPECT_NEAR(counted.second, counted.first * kSamples, 1.01) << "piece " << piece;
        EXPECT_NEAR(choice.probabilityOf(piece), counted.first, 1e-12) << "piece " << piece;
      }
      double sum = 0;
      for (std::uint32_t piece = 0; piece < lamps.size(); ++piece)
      {
        EXPECT_GT(choice.probabilityOf(piece), 0) << "piece " << piece;
        sum += choice.probabilityOf(piece);
      }
      EXPECT_NEAR(sum, 1, 1e-9) << edge << " x " << edge << " lamps";
    }
  }
}

// Lamps of 1e-30 of the power of others are chosen among each other by their own flux: what strong
// lamps in the same tree add up to rounds nothing of them away.
TEST(LampTree, AmongFaintLampsTheChoiceIsByTheirFlux)
{
  ObjectBuilder room;
  for (int i = 0; i < 64; ++i)
  {
    addPanel(room, { 0.1 * i, 0, 3 }, 0.1, 0.1, 1);
    addPanel(room, { 1000 + 0.1 * i, 0, 3 }, 0.1, 0.1, 1e-30 * (1 + i % 3));
  }
  const LightTable lights({ room.build(), {} }, 1000);
  const LampPieces lamps(lights);
  int looked = 0;
  for (const LampPieces::Node& node : lamps.nodes())
  {
    if (node.isLeaf() || node.lamp.flux > 1e-20)
    {
      continue;
    }
    for (double part = 0; part < 1; part += 0x1p-6)
    {
      const WeightChoice share = lamps.choose(node, part);
      EXPECT_TRUE(share.rest >= 0 && share.rest < 1);
      EXPECT_NEAR(share.weight, lamps[share.place].flux / node.lamp.flux, 1e-12);
      EXPECT_LT(lamps[share.place].flux, 1e-20);
    }
    ++looked;
  }
  EXPECT_GT(looked, 32);
}

// A cell just below one of 400 lamps asks that lamp mostly.
TEST(LampTree, ACellFindsTheLampsThatAreNear)
{
  const LightTable lights = manyLights(20);
  const LampPieces lamps(lights);
  LampChoice choice(lamps);
  choice.weigh(cellAt({ 0.55, 0.55, 2.98 }, 0.01));
  int near = 0;
  constexpr int kSamples = 10000;
  for (int i = 0; i < kSamples; ++i)
  {
    const LampPiece& lamp = lamps[choice.choose((i + 0.5) / kSamples).place];
    near += (lamp.center - Vector3(0.55, 0.55, 3)).norm() < 0.2 ? 1 : 0;
  }
  EXPECT_GT(near, 0.5 * kSamples);
}

}
}
