// SPDX-License-Identifier: BSD-3-Clause
// Law 1: after any sequence of frames, an updated filter has the bits of a new one.

#include "OutputBits.h"
#include "RandomPoses.h"
#include "TestScenes.h"

#include "vtkSMPTools.h"

#include <gtest/gtest.h>

using namespace TestScenes;

namespace
{

constexpr int NumberOfFrames = 200;
constexpr vtkIdType NumberOfWalks = 400;

/// Room [0, 3]^3 with a square lamp and a point light; each dynamic object is a difficult case.
Scene MakeDifficultScene(int bands)
{
  const auto tuple = [bands](double red, double green, double blue) {
    return bands == 1 ? std::vector<double>{ green } : std::vector<double>{ red, green, blue };
  };
  Mesh room = MakeRoom(3, 2);
  SetCellValues(room, "DiffuseReflectance", tuple(0.8, 0.6, 0.3));
  Scene scene{ { room, MakeLamp({ 1.5, 1.5, 2.9 }, 0.8, tuple(90, 100, 40)),
                 MakePointLight({ 0.3, 2.5, 1.2 }, tuple(20, 30, 60)) },
    {} };
  scene.Moving = {
    MakeMoving(MakeBall(0.4, 7), { 1, 1, 1 }),
    MakeMoving(MakeBox(0.5, 0.6, 0.7), { 2, 2, 0.35 }),   // its bottom lies in the floor
    MakeMoving(MakeBox(0.5, 0.6, 0.7), { 2, 2, 0.35 }),   // in the same place, at first
    MakeMoving(MakeCone(0.8, 0.3, 9), { 0.2, 1.5, 1.5 }), // through the wall
    MakeMoving(MakeRectangle({ -0.4, -0.4, 0 }, { 0.8, 0, 0 }, { 0, 0.8, 0 }, 2), { 1.5, 1, 2 }),
    MakeMoving(MakeBall(0.2, 6), { 2.2, 0.7, 1.4 }), // stays
    MakeMoving(MakeBall(0.05, 5), { 1, 1, 1 }),      // inside the first ball
  };
  return scene;
}

/// One step of one object.
void Step(RandomNumbers& random, vtkTransform* pose)
{
  switch (random.Below(8))
  {
    case 0: // stays
      break;
    case 1:
      ShiftALittle(random, pose);
      break;
    case 2:
      TurnAtRandom(random, pose);
      break;
    case 3: // shear
    {
      const double shear[16] = { 1, random.Between(-1, 1), 0, 0, 0, 1, random.Between(-1, 1), 0, 0,
        0, 1, 0, 0, 0, 0, 1 };
      PlaceInTheRoom(random, pose);
      pose->Concatenate(shear);
      break;
    }
    case 4: // reflection
      PlaceInTheRoom(random, pose);
      pose->Scale(-1, random.Between(0.5, 1.5), random.Between(0.5, 1.5));
      break;
    case 5: // leaves the room
      pose->Identity();
      pose->Translate(random.Between(50, 100), 0, -30);
      break;
    default:
      PlaceInTheRoom(random, pose);
  }
}

struct Configuration
{
  bool CacheStaticHits;
  int TraversalMode;
  int NumberOfThreads;

  friend std::ostream& operator<<(std::ostream& os, const Configuration& c)
  {
    return os << "cache " << c.CacheStaticHits << ", traversal " << c.TraversalMode << ", "
              << c.NumberOfThreads << " threads";
  }
};

void Update(vtkIrradianceFilter* filter, int threads)
{
  vtkSMPTools::LocalScope(
    vtkSMPTools::Config{ threads, "STDThread", false }, [filter] { filter->Update(); });
}

struct Updated
{
  Configuration Settings;
  vtkSmartPointer<vtkIrradianceFilter> Filter;
};

std::vector<Updated> MakeUpdatedFilters(const Scene& scene)
{
  std::vector<Updated> updated;
  for (const bool cache : { false, true })
  {
    for (const int mode : { 0, 1, 2 })
    {
      for (const int threads : { 1, 2 })
      {
        auto filter = MakeFilter(scene, NumberOfWalks);
        filter->SetCacheStaticHits(cache);
        filter->SetTraversalMode(mode);
        updated.push_back({ { cache, mode, threads }, filter });
      }
    }
  }
  return updated;
}

/// Object 5 stays. Now and then object 2 moves to its twin's place and object 4 lies down on the
/// floor, so rays hit two triangles at the same distance.
void StepAll(RandomNumbers& random, const Scene& scene)
{
  for (std::size_t i = 0; i < scene.Moving.size(); ++i)
  {
    vtkTransform* pose = scene.Moving[i].Pose;
    const bool isTie = (i == 2 || i == 4) && random.Below(3) == 0;
    if (isTie && i == 2)
    {
      pose->SetMatrix(scene.Moving[1].Pose->GetMatrix());
    }
    else if (isTie)
    {
      pose->Identity();
      pose->Translate(random.Between(0.5, 2.5), random.Between(0.5, 2.5), 0);
    }
    else if (i != 5)
    {
      Step(random, pose);
    }
  }
}

}

TEST(UpdateEqualsRebuild, InEveryConfiguration)
{
  constexpr std::uint64_t seed = 20260101;
  std::cout << "seed " << seed << ", " << NumberOfFrames << " frames, " << NumberOfWalks
            << " walks\n";
  RandomNumbers random(seed);
  const Scene scene = MakeDifficultScene(1);
  const std::vector<Updated> updated = MakeUpdatedFilters(scene);
  double invalid = 0, shootSeconds = 0;
  for (int frame = 0; frame < NumberOfFrames; ++frame)
  {
    const auto fresh = MakeFilter(scene, NumberOfWalks);
    Update(fresh, 1);
    const OutputBits expected(fresh);
    ASSERT_FALSE(expected.IsEmpty());
    for (const Updated& other : updated)
    {
      Update(other.Filter, other.Settings.NumberOfThreads);
      ASSERT_TRUE(IsSame(OutputBits(other.Filter), expected))
        << "frame " << frame << ", " << other.Settings;
      invalid += Field(other.Filter, "NumberOfInvalidWalks");
      shootSeconds += frame > 0 ? Field(other.Filter, "ShootSeconds") : 0;
    }
    StepAll(random, scene);
  }
  // The updates were real: some walks became invalid, but not all, and no frame was shot again.
  EXPECT_EQ(shootSeconds, 0);
  EXPECT_GT(invalid, 0.1 * 12 * NumberOfFrames * NumberOfWalks);
  EXPECT_LT(invalid, 0.9 * 12 * NumberOfFrames * NumberOfWalks);
}

TEST(UpdateEqualsRebuild, ThreeBandsAndSidesApart)
{
  constexpr std::uint64_t seed = 20260102;
  std::cout << "seed " << seed << "\n";
  RandomNumbers random(seed);
  const Scene scene = MakeDifficultScene(3);
  const auto updated = MakeFilter(scene, NumberOfWalks);
  updated->SeparateSidesOn();
  for (int frame = 0; frame < NumberOfFrames; ++frame)
  {
    const auto fresh = MakeFilter(scene, NumberOfWalks);
    fresh->SeparateSidesOn();
    fresh->Update();
    updated->Update();
    ASSERT_TRUE(IsSame(OutputBits(updated), OutputBits(fresh))) << "frame " << frame;
    StepAll(random, scene);
  }
  vtkCellData* cells = OutputOf(updated->GetOutput(), 0, 0)->GetCellData();
  ASSERT_TRUE(cells->HasArray("IrradianceFront"));
  ASSERT_TRUE(cells->HasArray("IrradianceBack"));
  EXPECT_FALSE(cells->HasArray("Irradiance"));
  EXPECT_EQ(cells->GetArray("IrradianceFront")->GetNumberOfComponents(), 3);
}

// Points change, cells stay: only the object's own tree is rebuilt.
TEST(UpdateEqualsRebuild, WhenObjectsDeform)
{
  constexpr std::uint64_t seed = 20260103;
  std::cout << "seed " << seed << "\n";
  RandomNumbers random(seed);
  const Scene scene = MakeDifficultScene(1);
  const auto updated = MakeFilter(scene, NumberOfWalks);
  for (int frame = 0; frame < 50; ++frame)
  {
    const auto fresh = MakeFilter(scene, NumberOfWalks);
    fresh->Update();
    updated->Update();
    ASSERT_TRUE(IsSame(OutputBits(updated), OutputBits(fresh))) << "frame " << frame;
    if (frame > 0)
    {
      EXPECT_EQ(Field(updated, "ShootSeconds"), 0);
    }
    for (const std::size_t i : { 0, 3, 4 })
    {
      vtkPoints* points = scene.Moving[i].Model->GetPoints();
      const vtkIdType point = random.Below(static_cast<int>(points->GetNumberOfPoints()));
      points->SetPoint(
        point, random.Between(-0.5, 0.5), random.Between(-0.5, 0.5), random.Between(-0.5, 0.5));
      points->Modified();
    }
    Step(random, scene.Moving[1].Pose);
  }
}

// So many small objects that the filter flattens them, and a large one that it instances.
TEST(UpdateEqualsRebuild, WithManySmallObjects)
{
  constexpr std::uint64_t seed = 20260104;
  std::cout << "seed " << seed << "\n";
  RandomNumbers random(seed);
  Scene scene{ { MakeRoom(3, 3), MakeLamp({ 1.5, 1.5, 2.875 }, 0.75, { 100 }) },
    { MakeMoving(MakeBall(0.4, 8), { 1, 1, 1 }) } };
  for (int i = 0; i < 130; ++i)
  {
    scene.Moving.push_back(MakeMoving(MakeBox(0.1, 0.2, 0.1),
      { random.Between(0.2, 2.8), random.Between(0.2, 2.8), random.Between(0.2, 2.6) }));
  }
  std::vector<vtkSmartPointer<vtkIrradianceFilter>> updated;
  for (const int mode : { vtkIrradianceFilter::OneTree, vtkIrradianceFilter::Sequential,
         vtkIrradianceFilter::Parallel })
  {
    updated.push_back(MakeFilter(scene, NumberOfWalks));
    updated.back()->SetTraversalMode(mode);
  }
  double invalid = 0;
  for (int frame = 0; frame < 10; ++frame)
  {
    const auto fresh = MakeFilter(scene, NumberOfWalks);
    fresh->Update();
    for (const auto& filter : updated)
    {
      filter->Update();
      ASSERT_TRUE(IsSame(OutputBits(filter), OutputBits(fresh)))
        << "frame " << frame << ", mode " << filter->GetTraversalMode();
      EXPECT_EQ(Field(filter, "ShootSeconds") == 0, frame > 0);
      invalid += Field(filter, "NumberOfInvalidWalks");
    }
    Step(random, scene.Moving[static_cast<std::size_t>(random.Below(131))].Pose);
    Step(random, scene.Moving[0].Pose);
  }
  EXPECT_GT(invalid, 0);
}
