// SPDX-License-Identifier: BSD-3-Clause
#include "EngineRun.h"
#include "MovingScene.h"
#include "ThreadExecution.h"

#include "../RayCasting/TestSimdLevels.h"

#include <gtest/gtest.h>

namespace irradiance
{

namespace
{

using test::Answer;
using test::MovingScene;

struct Case
{
  TraversalMode mode;
  bool cache;
  bool verify;
  bool isFlattened;
  std::shared_ptr<Execution> execution;
};

/// The answer for the last of the same three frames, computed in the given way.
Answer lastOfThreeFrames(const Case& way, bool separateSides)
{
  MovingScene scene(3, false, 41, true);
  EngineSettings settings;
  settings.numberOfWalks = test::scaled(8000);
  settings.traversalMode = way.mode;
  settings.cacheStaticHits = way.cache;
  settings.verify = way.verify;
  settings.separateSides = separateSides;
  IrradianceEngine engine;
  Answer answer;
  for (int frame = 0; frame < 3; ++frame, scene.nextFrame())
  {
    SceneObjects objects = scene.objects();
    for (SceneObject& object : objects.dynamicObjects)
    {
      object.isFlattened = object.isFlattened || way.isFlattened;
    }
    engine.update(objects, settings, *way.execution);
    answer = test::answerOf(engine, objects, separateSides);
  }
  return answer;
}

}

TEST(SameBits, WhateverTheWay)
{
  const std::vector<std::shared_ptr<Execution>> executions = { std::make_shared<Execution>(),
    std::make_shared<test::ThreadExecution>(2), std::make_shared<test::ThreadExecution>(7),
    std::make_shared<test::BackwardExecution>() };
  for (const bool sides : { false, true })
  {
    const Answer first =
      lastOfThreeFrames({ TraversalMode::Parallel, true, true, false, executions[0] }, sides);
    unsigned number = 0;
    for (const TraversalMode mode :
      { TraversalMode::OneTree, TraversalMode::Sequential, TraversalMode::Parallel })
    {
      for (const bool cache : { true, false })
      {
        for (const bool verify : { true, false })
        {
          for (const bool isFlattened : { true, false })
          {
            const auto& execution = executions[number++ % executions.size()];
            EXPECT_TRUE(
              lastOfThreeFrames({ mode, cache, verify, isFlattened, execution }, sides) == first)
              << "traversal " << int(mode) << ", cache " << cache << ", verify " << verify
              << ", loose " << isFlattened << ", execution " << (number - 1) % executions.size();
          }
        }
      }
    }
    for (const auto& execution : executions)
    {
      EXPECT_TRUE(lastOfThreeFrames(
                    { TraversalMode::Parallel, true, true, false, execution }, sides) == first);
    }
  }
}

TEST(SameBits, WhateverTheInstructions)
{
  const auto serial = std::make_shared<Execution>();
  const Answer best =
    lastOfThreeFrames({ TraversalMode::Parallel, true, true, false, serial }, false);
  for (const SimdLevel level : test::simdLevels())
  {
    const test::SimdLimit limit(level);
    EXPECT_TRUE(
      lastOfThreeFrames({ TraversalMode::Parallel, true, true, false, serial }, false) == best)
      << "SIMD level " << static_cast<int>(level);
  }
}

namespace
{

/// On all instruction sets.
void checkManyThatMove(int movers, double radius, int frames)
{
  test::ObjectBuilder room, grain;
  room.addBox(test::box({ 0, 0, 0 }, { 4, 4, 4 }), 3, test::grey(0.7), true);
  room.addPointLight({ 2, 2, 2 }, 3);
  grain.addSphere({ 0, 0, 0 }, radius, 4, test::grey(0.5));
  SceneObjects objects{ room.build(),
    std::vector<SceneObject>(static_cast<std::size_t>(movers), grain.build()) };
  EngineSettings settings;
  settings.numberOfWalks = test::scaled(20000);
  for (const SimdLevel level : test::simdLevels())
  {
    const test::SimdLimit limit(level);
    IrradianceEngine engine;
    test::ThreadExecution threads(2);
    for (int frame = 0; frame < frames; ++frame)
    {
      for (int i = 0; i < movers; ++i)
      {
        const auto at = [&](double step) { return 0.5 + 3 * std::fmod(step * (i + 1), 1.0); };
        objects.dynamicObjects[static_cast<std::size_t>(i)].worldFromObject =
          test::shift({ at(0.8191725134), at(0.6710436067) + 0.1 * frame, at(0.5497004779) });
      }
      engine.update(objects, settings, threads);
      EXPECT_EQ(engine.statistics().invalidWalks > 0, frame > 0);
      ASSERT_TRUE(test::answerOf(engine, objects) == test::freshAnswer(objects, settings))
        << "SIMD level " << static_cast<int>(level) << ", frame " << frame;
    }
  }
}

}

TEST(SameBits, AmongManyThatMoveWhateverTheInstructions)
{
  checkManyThatMove(24, 0.2, 4);
}

TEST(SameBits, AmongManySmallOnesThatMoveWhateverTheInstructions)
{
  checkManyThatMove(40, 0.05, 4);
}

// So many that casts find bodies by a tree.
TEST(SameBits, AmongVeryManyThatMoveWhateverTheInstructions)
{
  checkManyThatMove(520, 0.04, 3);
}

TEST(SameBits, SidesAddUpToTheSum)
{
  MovingScene scene(3, false, 42);
  EngineSettings together, apart;
  together.numberOfWalks = apart.numberOfWalks = test::scaled(10000);
  apart.separateSides = true;
  IrradianceEngine a, b;
  Execution execution;
  double back = 0;
  for (int frame = 0; frame < 5; ++frame, scene.nextFrame())
  {
    a.update(scene.objects(), together, execution);
    b.update(scene.objects(), apart, execution);
    for (std::uint32_t object = 0; object < scene.objects().size(); ++object)
    {
      for (std::size_t cell = 0; cell < scene.objects()[object].material->numberOfCells; ++cell)
      {
        for (int band = 0; band < 3; ++band)
        {
          ASSERT_EQ(a.sums().sum({ object, cell }, band),
            b.sums().sum({ object, cell }, band) + b.sums().sum({ object, cell, 1 }, band));
          back += b.sums().sum({ object, cell, 1 }, band);
        }
      }
    }
  }
  EXPECT_GT(back, 0);
}

}
