// SPDX-License-Identifier: BSD-3-Clause
#include "EngineRun.h"
#include "Estimates/ErrorEstimate.h"
#include "MovingScene.h"
#include "ThreadExecution.h"
#include "Walks/WalkSet.h"

#include <gtest/gtest.h>

#include <array>

// There may be several sets of walks in a scene, each with some of the lamps: each follows motions to
// the bits of a fresh start, and together they bring what one set with all lamps brings.

namespace irradiance
{
namespace
{

constexpr std::uint32_t kReplicates = 16;

WalkSettings settingsOf(std::uint64_t seed, std::uint32_t walks)
{
  WalkSettings settings;
  settings.numberOfWalks = test::scaled(walks);
  settings.seed = seed;
  settings.replicates = kReplicates;
  return settings;
}

/// The scene without its area lights, or without its point lights.
SceneObjects only(bool hasPoints, const SceneObjects& objects)
{
  Emission emission = *objects.staticObject.emission;
  hasPoints ? emission.exitance.clear() : emission.points.clear();
  SceneObjects some = objects;
  some.staticObject.emission = std::make_shared<const Emission>(std::move(emission));
  return some;
}

/// Two sets of walks in one scene: those of the area lights and those of the point lights.
class TwoSets
{
public:
  explicit TwoSets(std::uint32_t walks)
    : walks_(walks)
  {
  }

  void start(const SceneObjects& objects)
  {
    commit(objects, {});
    for (std::size_t i = 0; i < sets_.size(); ++i)
    {
      const WalkSettings settings = settingsOf(i + 1, walks_);
      const WalkPlan plan = WalkSet::planOf(settings);
      WalkSet& set = sets_[i];
      set.setSource(LightTable(only(i == 1, objects), plan.most()), plan);
      set.setSettings(settings);
      set.start(space(), execution_);
      set.shootRound(0, true, space(), execution_);
    }
  }
  void follow(const SceneObjects& objects)
  {
    const std::vector<bool> moved = findMoved(objects, objects_);
    commit(objects, moved);
    for (WalkSet& set : sets_)
    {
      set.follow(moved, space(), nullptr, execution_);
    }
  }
  const std::array<WalkSet, 2>& sets() const { return sets_; }

private:
  WalkSpace space() const { return { scene_, objects_, contacts_ }; }
  void commit(const SceneObjects& objects, const std::vector<bool>& moved)
  {
    objects_ = objects;
    scene_.setStatic(objects.staticObject.body);
    scene_.setDynamic(objects.dynamicBodies());
    scene_.commit(moved, {});
    contacts_.update(objects, sides_, {});
  }

  std::uint32_t walks_;
  test::ThreadExecution execution_{ 2 };
  SceneObjects objects_;
  Scene scene_;
  ObjectSides sides_;
  Contacts contacts_;
  std::array<WalkSet, 2> sets_;
};

TEST(WalkSet, TwoFollowMotionsToTheBitsOfAFreshStart)
{
  constexpr unsigned kSeed = 11;
  test::MovingScene scene(3, false, kSeed);
  constexpr std::uint32_t kWalks = 40000;
  TwoSets followed(kWalks);
  followed.start(scene.objects());
  const int frames = static_cast<int>(test::scaled(100));
  std::int64_t invalid = 0;
  for (int frame = 1; frame <= frames; ++frame)
  {
    scene.nextFrame();
    followed.follow(scene.objects());
    invalid += followed.sets()[0].statistics().invalidWalks;
    if (frame % 25 != 0 && frame != frames)
    {
      continue;
    }
    TwoSets fresh(kWalks);
    fresh.start(scene.objects());
    for (std::size_t i = 0; i < 2; ++i)
    {
      ASSERT_EQ(test::answerOf(followed.sets()[i], scene.objects()),
        test::answerOf(fresh.sets()[i], scene.objects()))
        << "set " << i << ", frame " << frame;
    }
  }
  EXPECT_GT(invalid, 0);
}

/// Of some 220 cells with an error bar, one is off by more than 5.5 standard errors (Student's t of 15
/// degrees of freedom) in one run of 70.
TEST(WalkSet, TwoBringWhatOneWithAllLampsBrings)
{
  constexpr unsigned kSeed = 12;
  test::MovingScene scene(1, true, kSeed);
  constexpr std::uint32_t kWalks = 200000;
  TwoSets two(kWalks);
  two.start(scene.objects());
  EngineSettings settings;
  static_cast<WalkSettings&>(settings) = settingsOf(3, kWalks);
  IrradianceEngine one;
  Execution serial;
  one.update(scene.objects(), settings, serial);
  const ErrorEstimate oneError = one.errorEstimate();
  std::vector<ErrorEstimate> errors;
  double flux = 0;
  for (const WalkSet& set : two.sets())
  {
    errors.emplace_back(set.sums(), set.plan(), 1, set.lights().largestStart());
    flux += set.lights().flux();
  }
  EXPECT_NEAR(flux, one.watts(one.balance().emitted.total()), 1e-9 * flux);
  int compared = 0;
  one.cells().numbers().forEach([&](const SceneCell& cell) {
    const CellSide side{ cell };
    double watts = 0, variance = std::pow(one.watts(oneError.standardError(side, 0)), 2);
    for (std::size_t i = 0; i < 2; ++i)
    {
      const WalkSet& set = two.sets()[i];
      watts += set.watts(static_cast<double>(set.sums().sum(side, 0)));
      variance += std::pow(set.watts(errors[i].standardError(side, 0)), 2);
    }
    if (!std::isnan(variance))
    {
      EXPECT_NEAR(watts, one.watts(one.sums().sum(side, 0)), 5.5 * std::sqrt(variance))
        << "cell " << cell.cell << " of object " << cell.object;
      ++compared;
    }
  });
  EXPECT_GT(compared, test::kIsSanitized ? 50 : 150);
}

}
}
