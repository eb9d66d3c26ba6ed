// SPDX-License-Identifier: BSD-3-Clause
#include "Views/OutgoingRadiance.h"

#include "MovingScene.h"
#include "ShownAnswer.h"
#include "TwoGroups.h"

#include <gtest/gtest.h>

namespace irradiance
{

namespace
{

using test::Answer;
using test::MovingScene;

void add(Answer& answer, double value)
{
  std::int64_t bits;
  std::memcpy(&bits, &value, sizeof(bits));
  answer.push_back(bits);
}

/// The bits of what an eye sees of all cells. The engine collects its photons, and from then on
/// keeps them up to date.
Answer viewsOf(IrradianceEngine& engine)
{
  Execution execution;
  const SceneObjects& objects = engine.objects();
  const OutgoingRadiance radiance(engine, 2, execution);
  engine.collectPhotons(execution); // for estimates from the nearest photons
  Answer answer;
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    for (std::size_t cell = 0; cell < objects[object].material->numberOfCells; ++cell)
    {
      for (const double value : radiance.at({ object, cell }, { { 0.1, 0.2, 0.3 } }).value)
      {
        add(answer, value);
      }
    }
  }
  return answer;
}

/// A scene whose objects move, leave and come back, in part as something else, and what is asked of
/// it.
class Program
{
public:
  explicit Program(unsigned seed)
    : random_(seed)
    , scene_(1, true, seed, true)
    , isAway_(MovingScene::kObjects, false)
    , hasGroups_(seed % 2 == 0)
  {
    settings.numberOfWalks = 300;
    settings.spreadPhotons = 60;
    settings.keepPhotons = true;
  }

  void nextStep()
  {
    settings.cellEstimate = isOneOf(2) ? CellEstimate::Sums : CellEstimate::Spread;
    settings.cacheStaticHits = isOneOf(2);
    settings.separateSides = settings.separateSides != isOneOf(8);
    if (isOneOf(8))
    {
      settings.replicates = settings.replicates == 1 ? 4 : 1;
    }
    scene_.nextFrame();
    objects = hasGroups_ ? test::inTwoGroups(scene_.objects()) : scene_.objects();
    for (std::size_t i = 0; i < isAway_.size(); ++i)
    {
      isAway_[i] = isAway_[i] != isOneOf(3);
      objects.dynamicObjects[i].isPresent = !isAway_[i];
    }
    replaceTheFirst();
  }

  SceneObjects objects;
  EngineSettings settings;

private:
  bool isOneOf(unsigned count) { return random_.engine() % count == 0; }

  /// It may return with other cells.
  void replaceTheFirst()
  {
    SceneObject& first = objects.dynamicObjects[0];
    if (!first.isPresent && isOneOf(3))
    {
      test::ObjectBuilder builder;
      builder.addSphere(
        { 0, 0, 0 }, 0.4, 3 + static_cast<int>(random_.engine() % 3), { { 0.3 }, {}, { 0.5 }, 9 });
      other_ = builder.build();
    }
    if (other_.body)
    {
      first.body = other_.body;
      first.material = other_.material;
    }
  }

  test::RandomVectors random_;
  MovingScene scene_;
  std::vector<bool> isAway_;
  bool hasGroups_; ///< two sets of walks
  SceneObject other_;
};

}

// Law 1. What an engine keeps of a part outlives the part's absence, and what it learns meanwhile,
// be it of an estimate, of photons or of nothing, is true when the part is back.
TEST(PartsAway, UpdateEqualsRebuildWhateverIsAskedMeanwhile)
{
  const unsigned programs = test::kIsSanitized ? 2 : 6;
  for (unsigned seed = 1; seed <= programs; ++seed)
  {
    Program program(seed);
    IrradianceEngine engine;
    Execution execution;
    for (int step = 0; step < 16; ++step)
    {
      program.nextStep();
      engine.update(program.objects, program.settings, execution);
      IrradianceEngine fresh;
      fresh.update(program.objects, program.settings, execution);
      ASSERT_TRUE(test::shownAnswer(engine, program.objects, program.settings) ==
        test::shownAnswer(fresh, program.objects, program.settings))
        << "program " << seed << ", step " << step;
      if (step % 3 != 1) // else the stores of photons are kept up to date unseen
      {
        ASSERT_TRUE(viewsOf(engine) == viewsOf(fresh)) << "program " << seed << ", step " << step;
      }
    }
  }
}

}
