// SPDX-License-Identifier: BSD-3-Clause
#include "DirectLight/LampChoice.h"

#include "Kit.h"

namespace irradiance::test
{
namespace
{

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
        const LampChoice::Choice one = choice.choose((i + 0.5) / kSamples);
        ASSERT_GE(one.rest, 0);
        ASSERT_LT(one.rest, 1);
        const auto known = chosen.emplace(one.piece, std::pair(one.probability, 0)).first;
        ASSERT_EQ(known->second.first, one.probability);
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
  const LampTree& tree = lamps.tree();
  int looked = 0;
  for (const LampTree::Node& node : tree.nodes())
  {
    if (node.isLeaf() || node.lamp.flux > 1e-20)
    {
      continue;
    }
    for (double part = 0; part < 1; part += 0x1p-6)
    {
      const LampTree::Choice share = tree.choose(node, part);
      EXPECT_TRUE(share.rest >= 0 && share.rest < 1);
      EXPECT_NEAR(share.probability, lamps[share.piece].flux / node.lamp.flux, 1e-12);
      EXPECT_LT(lamps[share.piece].flux, 1e-20);
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
    const LampPiece& lamp = lamps[choice.choose((i + 0.5) / kSamples).piece];
    near += (lamp.center - Vector3(0.55, 0.55, 3)).norm() < 0.2 ? 1 : 0;
  }
  EXPECT_GT(near, 0.5 * kSamples);
}

}
}
