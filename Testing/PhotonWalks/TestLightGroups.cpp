// SPDX-License-Identifier: BSD-3-Clause
#include "Kit.h"

#include "LightGroups.h"

#include <map>

// Light adds up over the groups of lamps; a factor multiplies it and costs nothing; each change
// gives the bits of a fresh start.

namespace irradiance::test
{
namespace
{

const std::vector<LampGroup> kTwo{ { "Panel", true }, { "Point", true } };

/// The scene with its point lights, all on the static object, in a group of their own.
SceneObjects inTwoGroups(const SceneObjects& objects)
{
  Emission emission = *objects.staticObject.emission;
  emission.groups.assign(objects.staticObject.material->numberOfCells, 0);
  for (const PointSource& source : emission.points)
  {
    emission.groups[source.cell] = 1;
  }
  SceneObjects grouped = objects;
  grouped.staticObject.emission = std::make_shared<const Emission>(std::move(emission));
  return grouped;
}

/// A static panel and a static point light, a lamp on a dynamic object, and things that move.
class LampScene
{
public:
  explicit LampScene(int bands = 1)
    : bands_(bands)
    , scene_(bands, true, 4)
  {
    objects_ = inTwoGroups(scene_.objects());
    ObjectBuilder lamp(bands);
    lamp.addBox(
      box({ -0.2, -0.2, -0.05 }, { 0.2, 0.2, 0.05 }), 1, { { 0.5, 0.5, 0.5 }, { 4, 5, 6 } });
    objects_.dynamicObjects.push_back(lamp.build(shift({ 2, 3, 1 })));
    auto emission = std::make_shared<Emission>(*objects_.dynamicObjects.back().emission);
    emission->group = 2;
    objects_.dynamicObjects.back().emission = emission;
  }

  const SceneObjects& objects() const { return objects_; }
  void moveThings()
  {
    scene_.nextFrame();
    std::copy(scene_.objects().dynamicObjects.begin(), scene_.objects().dynamicObjects.end(),
      objects_.dynamicObjects.begin());
  }
  void moveLamp(const Vector3& to) { lamp().worldFromObject = shift(to); }
  void switchLamp(bool isThere) { lamp().isPresent = isThere; }
  /// Of the panel.
  void setExitance(const Bands& watts)
  {
    auto emission = std::make_shared<Emission>(*objects_.staticObject.emission);
    for (std::size_t i = 0; i < emission->exitance.size(); ++i)
    {
      double& exitance = emission->exitance[i];
      exitance = exitance > 0 ? watts[i % static_cast<std::size_t>(bands_)] : 0;
    }
    objects_.staticObject.emission = emission;
  }

private:
  SceneObject& lamp() { return objects_.dynamicObjects.back(); }

  int bands_;
  MovingScene scene_;
  SceneObjects objects_;
};

const std::vector<LampGroup> kThree{ { "Panel", true }, { "Point", true }, { "Dynamic 6" } };

std::vector<LampGroup> dimmed(std::vector<LampGroup> groups, std::size_t which, double factor)
{
  groups[which].factor = { { factor, factor, factor } };
  return groups;
}

/// Groups that have been updated, serially.
struct Updated
{
  LightGroups groups;

  Updated() = default;
  Updated(const SceneObjects& objects, const std::vector<LampGroup>& lamps,
    const EngineSettings& settings)
  {
    update(objects, lamps, settings);
  }
  void update(const SceneObjects& objects, const std::vector<LampGroup>& lamps,
    const EngineSettings& settings)
  {
    Execution serial;
    groups.update({ objects, lamps, 0, {}, settings, [](const auto&, const auto&) {} }, serial);
  }
  const IrradianceEngine& engineOf(const std::string& name) const
  {
    return *std::find_if(groups.all().begin(), groups.all().end(), [&](const LightGroup& group) {
      return group.name == name;
    })->engine;
  }
  /// The bits of all that is said of cells.
  Answer shown() const
  {
    Answer answer;
    const LightGroupErrors errors(groups);
    const SceneCells& cells = groups.any().cells();
    forEachSide(groups.any().objects(), groups.any().settings().separateSides,
      [&](const CellSide& side, int band) {
        addBits(answer, groups.irradiance(side, band));
        addBits(answer, cells.area(side) > 0 ? errors.standardError(side, band) : 0);
      });
    return answer;
  }
};

/// Calls use(what all together show, factor of each times what it shows) for all cells.
template <class Use>
void forEachLight(const LightGroups& groups, const Use& use)
{
  forEachSide(groups.any().objects(), false, [&](const CellSide& side, int band) {
    std::map<std::string, double> parts;
    for (const LightGroup& group : groups.all())
    {
      parts[group.name] =
        group.engine ? group.shown(group.engine->irradiance(side, band), band) : 0;
    }
    use(groups.irradiance(side, band), parts);
  });
}

TEST(LightGroups, AddUpAndFactorsMultiplyExactly)
{
  const LampScene scene(3);
  const Shoot settings = Shoot(2000).errors(16);
  Updated full(scene.objects(), kThree, settings), dim(scene.objects(), kThree, settings);
  const double factor = 0.3;
  const std::uint64_t panel = dim.engineOf("Panel").state();
  dim.update(scene.objects(), dimmed(kThree, 0, factor), settings);
  EXPECT_EQ(dim.engineOf("Panel").state(), panel + 1);
  std::vector<std::map<std::string, double>> before;
  forEachLight(full.groups, [&](double all, const std::map<std::string, double>& parts) {
    double sum = 0;
    for (const auto& [name, light] : parts)
    {
      sum += light;
    }
    ASSERT_EQ(all, sum);
    before.push_back(parts);
  });
  auto next = before.begin();
  double changed = 0;
  forEachLight(dim.groups, [&](double, const std::map<std::string, double>& parts) {
    ASSERT_EQ(parts.at("Panel"), factor * next->at("Panel"));
    ASSERT_EQ(parts.at("Point"), next->at("Point"));
    changed += (next++)->at("Panel");
  });
  EXPECT_GT(changed, 0);
}

/// No walk and no ray.
TEST(LightGroups, CostNothingWhereTheyAreOff)
{
  LampScene scene;
  const Shoot settings = Shoot(2000).finalGather(8);
  Updated run(scene.objects(), kThree, settings);
  const std::uint64_t state = run.engineOf("Dynamic 6").state();
  const std::shared_ptr<IrradianceEngine> engine = run.groups.all().front().engine;
  run.update(scene.objects(), dimmed(kThree, 0, 0.5), settings);
  EXPECT_EQ(run.engineOf("Dynamic 6").statistics().repairedSegments, 0);
  run.groups.forEachLit([](const LightGroup& group) {
    EXPECT_EQ(group.engine->statistics().shootSeconds, 0) << group.name;
    EXPECT_EQ(group.engine->statistics().suspectSegments, 0) << group.name;
    EXPECT_EQ(group.engine->statistics().followedPaths, 0) << group.name;
  });
  for (int frame = 0; frame < 3; ++frame)
  {
    scene.moveThings();
    scene.moveLamp({ 1.0 + frame, 1, 1 });
    run.update(scene.objects(), dimmed(kThree, 2, 0), settings);
    EXPECT_EQ(run.groups.all()[0].name, "Dynamic 6");
    EXPECT_EQ(run.groups.all()[0].engine, nullptr);
  }
  EXPECT_EQ(engine->state(), state + 1) << "as after the change of a factor";
  run.update(scene.objects(), kThree, settings);
  EXPECT_EQ(run.shown(), Updated(scene.objects(), kThree, settings).shown());
}

/// The walks of others are verified.
TEST(LightGroups, ALampThatMovesShootsItsOwnWalksAlone)
{
  LampScene scene;
  const Shoot settings(scaled(20000));
  Updated run(scene.objects(), kThree, settings);
  scene.moveLamp({ 1, 1, 1.5 });
  run.update(scene.objects(), kThree, settings);
  EXPECT_GT(run.engineOf("Dynamic 6").statistics().shootSeconds, 0);
  for (const char* resting : { "Panel", "Point" })
  {
    const EngineStatistics& statistics = run.engineOf(resting).statistics();
    EXPECT_EQ(statistics.shootSeconds, 0) << resting;
    EXPECT_GT(statistics.invalidWalks, 0) << resting;
    EXPECT_LT(statistics.repairedSegments, run.engineOf(resting).balance().segments / 4) << resting;
  }
  EXPECT_EQ(run.shown(), Updated(scene.objects(), kThree, settings).shown());
}

/// Whatever the exitance and its colour are: the lamps of a group are scaled.
TEST(LightGroups, LampsThatAllChangeAlikeShootNothing)
{
  LampScene scene(3);
  const Shoot settings = Shoot(1000).errors(16);
  Updated run(scene.objects(), kThree, settings);
  for (const Bands& exitance : { Bands{ { 1.7, 0.3, 11 } }, Bands{ { 1e-9, 1e7, 1 } } })
  {
    scene.setExitance(exitance);
    run.update(scene.objects(), kThree, settings);
    EXPECT_EQ(run.engineOf("Panel").statistics().shootSeconds, 0);
    EXPECT_EQ(run.shown(), Updated(scene.objects(), kThree, settings).shown());
  }
}

/// A single group that nobody named is the engine itself.
TEST(LightGroups, ANewSeedShootsItsGroupAlone)
{
  const LampScene scene;
  const EngineSettings settings = Shoot(scaled(3000)).errors(2);
  std::vector<LampGroup> lamps = kThree;
  Updated updated(scene.objects(), lamps, settings);
  const Answer before = updated.shown();
  lamps[1].seed = 7;
  updated.update(scene.objects(), lamps, settings);
  EXPECT_FALSE(updated.shown() == before);
  EXPECT_TRUE(updated.shown() == Updated(scene.objects(), lamps, settings).shown());
  EXPECT_GT(updated.engineOf("Point").statistics().shootSeconds, 0);
  EXPECT_EQ(updated.engineOf("Panel").statistics().shootSeconds, 0);
  EXPECT_EQ(updated.engineOf("Dynamic 6").statistics().shootSeconds, 0);
  lamps[1].seed = settings.seed; // as that of all
  updated.update(scene.objects(), lamps, settings);
  EXPECT_TRUE(updated.shown() == before);
}

TEST(LightGroups, OneWithoutANameIsAsIfThereWereNone)
{
  const MovingScene scene(1, true, 9);
  const Shoot settings = Shoot(1000).errors(16);
  const Updated run(scene.objects(), { { "Static" } }, settings);
  EXPECT_EQ(shownAnswer(run.groups.any()), shownAnswer(UpdatedEngine(scene.objects(), settings)));
  EXPECT_FALSE(run.groups.areSeveral());
}

TEST(LightGroups, AreDarkWhereNothingShines)
{
  const LampScene scene;
  Updated run(scene.objects(), dimmed(dimmed(dimmed(kThree, 0, 0), 1, 0), 2, 0), Shoot(1000));
  forEachLight(run.groups, [](double all, const auto&) { ASSERT_EQ(all, 0); });
  EXPECT_EQ(run.groups.all().size(), 3u);
  run.update(scene.objects(), kThree, Shoot(1000));
  EXPECT_EQ(run.shown(), Updated(scene.objects(), kThree, Shoot(1000)).shown());
}

/// What two groups bring is what one brings. Of some 200 cells one is off by more than 5.5 standard
/// errors (Student's t of 15 degrees of freedom) in one run of 70.
TEST(LightGroups, BringWhatOneWithAllLampsBrings)
{
  const MovingScene scene(1, true, 12);
  const Shoot settings = Shoot(scaled(200000)).errors(16);
  const Updated two(inTwoGroups(scene.objects()), kTwo, settings);
  const UpdatedEngine one(scene.objects(), settings);
  const ErrorEstimate errors = one.errorEstimate();
  const LightGroupErrors sums(two.groups);
  int known = 0;
  forEachSide(scene.objects(), false, [&](const CellSide& side, int band) {
    if (const double area = one.cells().area(side); area > 0)
    {
      const double error = std::hypot(
        one.watts(errors.standardError(side, band)) / area, sums.standardError(side, band));
      const double off = two.groups.irradiance(side, band) - one.irradiance(side, band);
      known += std::isnan(error) ? 0 : 1;
      EXPECT_FALSE(std::abs(off) > 5.5 * error) << off / error;
    }
  });
  EXPECT_GT(known, kIsSanitized ? 50 : 150);
}

/// Changes of all kinds, alone and together.
class LightGroupPrograms : public testing::TestWithParam<EngineSettings>
{
};

TEST_P(LightGroupPrograms, GiveTheBitsOfAFreshStart)
{
  for (const int bands : { 1, 3 })
  {
    RandomVectors random(17u + static_cast<unsigned>(bands));
    LampScene scene(bands);
    std::vector<LampGroup> lamps = kThree;
    Updated run;
    for (int frame = 0; frame < (kIsSanitized ? 6 : 12); ++frame)
    {
      const auto happens = [&] { return random.engine() % 3 == 0; };
      happens() ? scene.moveThings() : void();
      happens() ? scene.moveLamp({ random.uniform(1, 3), random.uniform(1, 3), 1 }) : void();
      happens() ? scene.switchLamp(random.engine() % 4 > 0) : void();
      happens() ? scene.setExitance({ { random.uniform(0, 9), 2, random.uniform(0, 9) } }) : void();
      if (happens())
      {
        const double factors[] = { 0, 1, random.uniform(0, 2) };
        lamps = dimmed(lamps, random.engine() % 3, factors[random.engine() % 3]);
      }
      run.update(scene.objects(), lamps, GetParam());
      ASSERT_EQ(run.shown(), Updated(scene.objects(), lamps, GetParam()).shown())
        << "frame " << frame << ", " << bands << " bands";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(OfAllMethods, LightGroupPrograms,
  testing::Values(Shoot(700).errors(16), Shoot(500).spread(40).bySide(), Shoot(500).finalGather(4),
    Shoot(500).gathered().cached()));

/// A budget leaves some walks stale; the calls after it end where a fresh start does.
TEST(LightGroups, ShareABudgetOfTime)
{
  LampScene scene;
  Shoot settings(2000);
  Updated run(scene.objects(), kThree, settings.budget(kNoTime));
  scene.moveThings();
  run.update(scene.objects(), kThree, settings);
  EXPECT_TRUE(run.engineOf("Panel").walks().hasStale());
  for (int call = 0; call < 200 &&
       run.groups.count([](const auto& engine) { return engine.walks().hasStale() ? 1 : 0; }) > 0;
       ++call)
  {
    run.update(scene.objects(), kThree, settings);
  }
  EXPECT_EQ(run.shown(), Updated(scene.objects(), kThree, Shoot(2000)).shown());
}

}
}
