// SPDX-License-Identifier: BSD-3-Clause
// Direct light, shot or gathered, as the user of the filter sees it.

#include "Agreement.h"
#include "ErrorObserver.h"
#include "ExposureScenes.h"
#include "OutputBits.h"
#include "OutputChecks.h"
#include "RandomPoses.h"
#include "ShownWalks.h"
#include "TestScenes.h"
#include "ViewFilters.h"

#include "vtkSMPTools.h"

#include <gtest/gtest.h>

#include <functional>
#include <sstream>

using namespace TestScenes;
using OutputChecks::AreaOf;
using OutputChecks::LeavesOf;

namespace
{

using Setting = std::function<void(vtkIrradianceFilter*)>;

vtkSmartPointer<vtkIrradianceFilter> MakeGathered(const Scene& scene, vtkIdType walks)
{
  auto filter = MakeFilter(scene, walks);
  filter->SetDirectLightToGathered();
  return filter;
}

/// Three bands, an area light and a point light, glossy cells, and a mirror.
Scene MakeGlossyScene()
{
  Mesh room = MakeRoom(3, 2);
  SetCellValues(room, "DiffuseReflectance", { 0.7, 0.5, 0.2 });
  Mesh ball = MakeBall(0.4, 7), box = MakeBox(0.5, 0.6, 0.7);
  for (const Mesh& glossy : { ball, box })
  {
    SetCellValues(glossy, "DiffuseReflectance", { 0.2 });
    SetCellValues(glossy, "SpecularReflectance", { 0.6, 0.4, 0.3 });
  }
  SetCellValues(ball, "PhongExponent", { 20 });
  return { { room, MakeLamp({ 1.5, 1.5, 2.9 }, 0.8, { 90, 100, 40 }),
             MakePointLight({ 0.3, 2.5, 1.2 }, { 20, 30, 60 }) },
    { MakeMoving(ball, { 1, 1, 1 }),
      MakeMoving(box, { 2, 2, 0.35 }),                      // its bottom lies in the floor
      MakeMoving(MakeCone(0.8, 0.3, 9), { 0.2, 1.5, 1.5 }), // through the wall
      MakeMoving(
        MakeRectangle({ -0.4, -0.4, 0 }, { 0.8, 0, 0 }, { 0, 0.8, 0 }, 2), { 1.5, 1, 2 }) } };
}

/// Nothing keeps the light in.
Scene MakeOpenScene()
{
  return { { MakeRectangle({ -2, -2, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 6),
             MakeLamp({ 0, 0, 1 }, 0.5, { 100 }) },
    { MakeMoving(MakeBall(0.3, 8), { 0.2, 0.1, 0.4 }) } };
}

/// A light table, on which a box stands, and a lamp that lies exactly in the ceiling.
Scene MakeTouchingScene()
{
  Mesh table = MakeRectangle({ 0.5, 0.5, 0.5 }, { 1, 0, 0 }, { 0, 1, 0 }, 2);
  SetCellValues(table, "RadiantExitance", { 60 });
  return { { MakeRoom(2, 3), table, MakeLamp({ 1, 1, 2 }, 0.6, { 80 }) },
    { MakeMoving(MakeBox(0.5, 0.5, 0.5), { 1, 1, 0.75 }) } };
}

/// An eye, and sensors on the floor and near a ball.
RandomModels::View MakeView()
{
  RandomModels::View view;
  view.HasEye = view.HasSensors = true;
  view.Eye = { 2.5, 0.4, 1.8 };
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  for (int i = 0; i < 40; ++i)
  {
    const double x = 0.2 + 0.3 * (i % 8), y = 0.3 + 0.5 * (i / 8);
    points->InsertNextPoint(x, y, i % 3 == 0 ? 1.1 : 0);
    normals->InsertNextTuple3(0, i % 3 == 0 ? 0.5 : 0, 1);
  }
  view.Sensors = Mesh::New();
  view.Sensors->SetPoints(points);
  view.Sensors->GetPointData()->SetNormals(normals);
  view.NumberOfPhotons = 20;
  return view;
}

}

// Who reads photons has them, also where nothing can move and the filter had not kept any. That
// changes nothing of the filter's output.
TEST(DirectLight, FiltersThatReadPhotonsMayCome)
{
  for (const bool isStill : { true, false })
  {
    Scene scene = MakeSmallScene();
    isStill ? scene.Moving.clear() : void();
    const auto filter = MakeGathered(scene, 1000);
    filter->Update();
    const OutputBits expected(filter);
    ViewFilters views(filter);
    views.Apply(MakeView());
    views.Update();
    views.ExpectSound();
    EXPECT_TRUE(IsSame(OutputBits(filter), expected));
    for (const vtkIdType count : { 3, 0 })
    {
      filter->SetNumberOfOutputWalks(count);
      filter->Update();
      EXPECT_EQ(filter->GetWalksOutput()->GetNumberOfCells(), count);
      EXPECT_TRUE(IsSame(OutputBits(filter), expected));
    }
  }
}

TEST(DirectLight, ShotAndGatheredAgree)
{
  ExpectAgreement(MakeSmallScene(), false);
  ExpectAgreement(MakeGlossyScene(), true);
  ExpectAgreement(MakeOpenScene(), true);
}

// Of two faces in the same place one receives what comes from afar, and each what the other sends.
TEST(DirectLight, ShotAndGatheredAgreeWhereThingsTouch)
{
  ExpectAgreement(MakeTouchingScene(), true);
}

// Where little is reflected and cells are many, direct light is nearly all of the light, and
// gathered light has little noise. Noise is the scatter over seeds; the two are 1.74 apart.
TEST(DirectLight, GatheredIsLessNoisy)
{
  Scene scene = MakeSmallScene();
  scene.Fixed[0] = MakeRoom(3, 12);
  const auto noiseOf = [&](int directLight) {
    const auto filter = MakeFilter(scene, 50000);
    filter->SetDefaultDiffuseReflectance(0.1);
    filter->SetDirectLight(directLight);
    constexpr int seeds = 8;
    std::vector<double> sum, squares;
    for (int seed = 1; seed <= seeds; ++seed)
    {
      filter->SetSeed(seed);
      filter->Update();
      vtkDataArray* values = IrradianceOf(filter, 0, 0);
      sum.resize(static_cast<std::size_t>(values->GetNumberOfTuples()));
      squares.resize(sum.size());
      for (std::size_t i = 0; i < sum.size(); ++i)
      {
        const double value = values->GetComponent(static_cast<vtkIdType>(i), 0);
        sum[i] += value;
        squares[i] += value * value;
      }
    }
    double variance = 0;
    for (std::size_t i = 0; i < sum.size(); ++i)
    {
      variance += (squares[i] - sum[i] * sum[i] / seeds) / (seeds - 1);
    }
    return std::sqrt(variance);
  };
  const double shot = noiseOf(vtkIrradianceFilter::Shot),
               gathered = noiseOf(vtkIrradianceFilter::Gathered);
  std::cout << "noise of shot light is " << shot / gathered << " times that of gathered light\n";
  EXPECT_LT(gathered, shot / 1.4);
}

namespace
{

void Update(vtkIrradianceFilter* filter, int threads)
{
  vtkSMPTools::LocalScope(
    vtkSMPTools::Config{ threads, "STDThread", false }, [filter] { filter->Update(); });
}

void Step(RandomNumbers& random, MovingObject& moving, const Mesh& model)
{
  vtkTransform* pose = moving.Pose;
  switch (random.Below(6))
  {
    case 0: // stays
      break;
    case 1:
      ShiftALittle(random, pose);
      break;
    case 2:
      TurnAtRandom(random, pose);
      break;
    case 3: // leaves, or comes back
      moving.Model->GetNumberOfCells() > 0 ? moving.Model->ShallowCopy(Mesh::New())
                                           : moving.Model->ShallowCopy(model);
      break;
    default:
      PlaceInTheRoom(random, pose);
      pose->Scale(1, random.Below(2) == 0 ? 1 : -0.7, 1.3);
  }
}

/// Takes filters with other traversals and threads through random frames, and compares them with
/// new ones.
void ExpectUpdatesOfNew(Scene scene, int frames, vtkIdType walks, const Setting& set)
{
  std::vector<Mesh> models;
  for (MovingObject& moving : scene.Moving)
  {
    models.push_back(moving.Model);
    moving.Model = Copy(moving.Model);
  }
  std::vector<vtkSmartPointer<vtkIrradianceFilter>> updated;
  for (const int mode : { 0, 1, 2 })
  {
    updated.push_back(MakeGathered(scene, walks));
    updated.back()->SetTraversalMode(mode);
    updated.back()->SetCacheStaticHits(mode != 1);
    set(updated.back());
  }
  RandomNumbers random(28);
  double repairs = 0;
  for (int frame = 0; frame < frames; ++frame)
  {
    const auto fresh = MakeGathered(scene, walks);
    set(fresh);
    Update(fresh, 1 + frame % 2);
    ASSERT_FALSE(OutputBits(fresh).IsEmpty());
    for (std::size_t i = 0; i < updated.size(); ++i)
    {
      Update(updated[i], 1 + static_cast<int>(i) % 2);
      ASSERT_TRUE(IsSame(OutputBits(updated[i]), OutputBits(fresh)))
        << "frame " << frame << ", traversal " << i;
      EXPECT_EQ(Field(updated[i], "ShootSeconds") > 0, frame == 0) << "frame " << frame;
    }
    repairs += updated[0]->GetFigure("NumberOfRepairedSegments");
    for (std::size_t i = 0; i < scene.Moving.size(); ++i)
    {
      Step(random, scene.Moving[i], models[i]);
    }
  }
  EXPECT_GT(repairs, 0);
}

}

TEST(DirectLight, UpdateEqualsRebuildInGrey)
{
  ExpectUpdatesOfNew(MakeSmallScene(), 30, 3000, [](vtkIrradianceFilter*) {});
}

TEST(DirectLight, UpdateEqualsRebuildWithAllElse)
{
  ExpectUpdatesOfNew(MakeGlossyScene(), 40, 3000, [](vtkIrradianceFilter* filter) {
    filter->SeparateSidesOn();
    filter->ComputeStandardErrorOn();
    filter->SetNumberOfReplicates(5);
  });
}

TEST(DirectLight, UpdateEqualsRebuildWhereThingsTouch)
{
  ExpectUpdatesOfNew(
    MakeTouchingScene(), 30, 3000, [](vtkIrradianceFilter* filter) { filter->SeparateSidesOn(); });
}

// A body comes to the lamp, and with it contacts. Then another rule decides which of two faces of
// the floor the light meets, far from the body. (Found by random programs.)
TEST(DirectLight, UpdateEqualsRebuildWhereABodyComesToTheLamp)
{
  const Scene scene{ { MakeRoom(3, 3), MakeLamp({ 1.5, 1.5, 2.75 }, 0.75, { 100 }),
                       MakeRectangle({ 0.25, 0, 0 }, { 2, 0, 0 }, { 0, 0.5, 0 }, 3) },
    { MakeMoving(MakeBox(0.25, 0.5, 0.25), { 1.5, 2.7, 2.5 }) } };
  const auto updated = MakeGathered(scene, 3000);
  updated->Update();
  for (const double y : { 1.5, 2.7, 1.25 })
  {
    scene.Moving[0].Pose->Identity();
    scene.Moving[0].Pose->Translate(1.5, y, 2.625); // its top lies in the lamp
    const auto fresh = MakeGathered(scene, 3000);
    updated->Update();
    fresh->Update();
    ASSERT_TRUE(IsSame(OutputBits(updated), OutputBits(fresh))) << "y " << y;
    EXPECT_EQ(Field(updated, "ShootSeconds"), 0);
  }
}

// Law 1 for all that reads photons and walks.
TEST(DirectLight, UpdateEqualsRebuildForAllThatReadsPhotons)
{
  const Scene scene = MakeGlossyScene();
  const auto make = [&] {
    const auto filter = MakeGathered(scene, 2000);
    filter->SetCellEstimateToSpread();
    filter->SetNumberOfSpreadPhotons(30);
    filter->SetNumberOfOutputWalks(50);
    filter->SeparateSidesOn();
    return filter;
  };
  const auto updated = make();
  ViewFilters ofUpdated(updated);
  ofUpdated.Apply(MakeView());
  RandomNumbers random(31);
  for (int frame = 0; frame < 8; ++frame)
  {
    const auto fresh = make();
    ViewFilters ofFresh(fresh);
    ofFresh.Apply(MakeView());
    ofUpdated.Update();
    ofFresh.Update();
    ASSERT_NO_FATAL_FAILURE(ofFresh.ExpectSound());
    ASSERT_TRUE(IsSame(ofUpdated, ofFresh)) << "frame " << frame;
    ASSERT_TRUE(IsSame(OutputBits(updated), OutputBits(fresh))) << "frame " << frame;
    ASSERT_TRUE(IsSame(ShownWalks::LastingBits(updated->GetWalksOutput()),
      ShownWalks::LastingBits(fresh->GetWalksOutput())));
    EXPECT_EQ(fresh->GetWalksOutput()->GetNumberOfCells(), 50);
    // At first some ask for photons, others do not: the source executes twice, and shoots once.
    EXPECT_TRUE(frame == 0 || Field(updated, "ShootSeconds") == 0) << "frame " << frame;
    for (const MovingObject& moving : scene.Moving)
    {
      PlaceInTheRoom(random, moving.Pose);
    }
  }
}

namespace
{

/// The means over some seeds of what a filter gives as one number, and their standard errors.
struct SeedMean
{
  double Mean = 0, Error = 0;

  template <class Measure>
  SeedMean(vtkIrradianceFilter* filter, int firstSeed, const Measure& measure)
  {
    constexpr int seeds = 24;
    double squares = 0;
    for (int i = 0; i < seeds; ++i)
    {
      filter->SetSeed(firstSeed + i);
      const double value = measure();
      this->Mean += value / seeds;
      squares += value * value / seeds;
    }
    this->Error = std::sqrt((squares - this->Mean * this->Mean) / (seeds - 1));
  }
};

/// Of two means with 23 degrees of freedom each: by chance once in 20,000.
void ExpectSameMean(const SeedMean& shot, const SeedMean& gathered, double within)
{
  std::cout << shot.Mean << " +- " << shot.Error << " shot, " << gathered.Mean << " +- "
            << gathered.Error << " gathered\n";
  EXPECT_NEAR(gathered.Mean, shot.Mean, 4.5 * std::hypot(shot.Error, gathered.Error));
  EXPECT_LT(std::hypot(shot.Error, gathered.Error), within * shot.Mean) << "a test of nothing";
}

}

// At a place where light changes little from there to the nearest photons.
TEST(DirectLight, SensorsAgree)
{
  RandomModels::View view = MakeView();
  view.HasEye = false;
  view.NumberOfPhotons = 100;
  const auto measure = [&](int directLight, int firstSeed) {
    const auto filter = MakeFilter(MakeSmallScene(), 100000);
    filter->SetDirectLight(directLight);
    ViewFilters views(filter);
    views.Apply(view);
    return SeedMean(filter, firstSeed, [&] {
      views.Update();
      vtkDataArray* values = views.Probe->GetOutput()->GetPointData()->GetArray("Irradiance");
      return values->GetComponent(1, 0) + values->GetComponent(7, 0); // on the floor
    });
  };
  ExpectSameMean(
    measure(vtkIrradianceFilter::Shot, 1), measure(vtkIrradianceFilter::Gathered, 101), 0.04);
}

// What the glossy ball, and the box, a mirror, show of a room with two lights.
TEST(DirectLight, RadianceAgrees)
{
  RandomModels::View view = MakeView();
  view.HasSensors = false;
  for (const unsigned int moving : { 0u, 1u })
  {
    const auto measure = [&](int directLight, int firstSeed) {
      const auto filter = MakeFilter(MakeGlossyScene(), 50000);
      filter->SetDirectLight(directLight);
      ViewFilters views(filter);
      views.Apply(view);
      return SeedMean(filter, firstSeed, [&] {
        views.Update();
        vtkPolyData* leaf =
          OutputOf(vtkMultiBlockDataSet::SafeDownCast(views.Radiance->GetOutput()), 1, moving);
        double sum = 0;
        for (vtkIdType cell = 0; cell < leaf->GetNumberOfCells(); ++cell)
        {
          sum +=
            AreaOf(leaf, cell) * leaf->GetCellData()->GetArray("Radiance")->GetComponent(cell, 1);
        }
        return sum;
      });
    };
    ExpectSameMean(
      measure(vtkIrradianceFilter::Shot, 1), measure(vtkIrradianceFilter::Gathered, 101), 0.03);
  }
}

// Lamps, settings and the way in which light is known may change at any time.
TEST(DirectLight, OtherChangesStartAnew)
{
  Scene scene = MakeGlossyScene();
  scene.Moving.push_back(MakeMoving(MakeLamp({ 0, 0, 0 }, 0.3, { 50 }), { 2, 1, 2 }));
  const auto updated = MakeGathered(scene, 2000);
  const Setting settings[] = {
    [](auto*) {},
    [&](auto*) { scene.Moving[4].Pose->RotateX(20); },
    [](auto* f) { f->SetDirectLightToShot(); },
    [](auto* f) { f->SetDirectLightToGathered(); },
    [](auto* f) { f->SetNumberOfWalks(2500); },
    [](auto* f) { f->SetSeed(3); },
    [](auto* f) { f->SeparateSidesOn(); },
    [](auto* f) { f->ComputeStandardErrorOn(); },
    [](auto* f) { f->SetUpdateModeToRebuild(); },
    [&](auto*) { scene.Moving[0].Pose->Translate(0.1, 0, 0); },
    [](auto* f) { f->SetUpdateModeToVerify(); },
    [](auto* f) { f->SetDefaultDiffuseReflectance(0.2); },
    [](auto* f) { f->SetDirectLightToShot(); },
  };
  for (std::size_t i = 0; i < std::size(settings); ++i)
  {
    settings[i](updated);
    const auto fresh = MakeFilter(scene, updated->GetNumberOfWalks());
    fresh->SetDirectLight(updated->GetDirectLight());
    fresh->SetSeed(updated->GetSeed());
    fresh->SetSeparateSides(updated->GetSeparateSides());
    fresh->SetComputeStandardError(updated->GetComputeStandardError());
    fresh->SetDefaultDiffuseReflectance(updated->GetDefaultDiffuseReflectance());
    updated->Update();
    fresh->Update();
    ASSERT_TRUE(IsSame(OutputBits(updated), OutputBits(fresh))) << "after change " << i;
  }
}

// How many walks start depends on how much static cells reflect, also where nothing static shines.
TEST(DirectLight, ReflectanceStartsAnewWhereOnlyAMovingLampShines)
{
  const Scene scene{ { MakeRoom(3, 3) },
    { MakeMoving(MakeLamp({ 0, 0, 0 }, 0.75, { 100 }), { 1.5, 1.5, 2.5 }) } };
  const auto updated = MakeGathered(scene, 3000);
  for (const double reflectance : { 0.5, 0.2, 0.8 })
  {
    SetCellValues(scene.Fixed[0], "DiffuseReflectance", { reflectance });
    scene.Fixed[0]->Modified();
    const auto fresh = MakeGathered(scene, 3000);
    updated->Update();
    fresh->Update();
    ASSERT_TRUE(IsSame(OutputBits(updated), OutputBits(fresh))) << "reflectance " << reflectance;
  }
}

TEST(DirectLight, PowerBalances)
{
  const struct
  {
    Scene Make;
    std::vector<double> Watts; // m2 W/m2, and of points
  } scenes[] = { { MakeSmallScene(), { 0.5625 * 100 } },
    { MakeGlossyScene(), { 0.64 * 90 + 20, 0.64 * 100 + 30, 0.64 * 40 + 60 } },
    { MakeOpenScene(), { 0.25 * 100 } }, { MakeTouchingScene(), { 60 + 0.36 * 80 } } };
  for (const auto& [scene, watts] : scenes)
  {
    const auto filter = MakeGathered(scene, 2000);
    for (int frame = 0; frame < 4; ++frame)
    {
      filter->Update();
      ASSERT_EQ(
        IrradianceOf(filter, 0, 0)->GetNumberOfComponents(), static_cast<int>(watts.size()));
      for (int band = 0; band < static_cast<int>(watts.size()); ++band)
      {
        const double emitted = Field(filter, "EmittedPower", band);
        EXPECT_NEAR(emitted, watts[static_cast<std::size_t>(band)], 1e-6 * emitted);
        EXPECT_NEAR(emitted,
          Field(filter, "AbsorbedPower", band) + Field(filter, "EscapedPower", band),
          1e-14 * emitted);
        EXPECT_EQ(Field(filter, "StalePower", band), 0);
      }
      scene.Moving[0].Pose->Translate(0.1, 0.05, 0);
    }
  }
}

// What escapes from a closed room is nothing but the noise of the estimate, on either side of zero:
// its mean over the seeds is off by 5 of its standard errors once in 20,000 (t with 23 degrees of
// freedom). Of an open scene it is what shot walks say.
TEST(DirectLight, EscapedPowerIsRightOnTheAverage)
{
  for (const bool isOpen : { false, true })
  {
    const Scene scene = isOpen ? MakeOpenScene() : MakeSmallScene();
    const auto filter = MakeGathered(scene, 4000);
    constexpr int seeds = 24;
    double sum = 0, squares = 0, least = 1e9, stated = 0;
    for (int seed = 1; seed <= seeds; ++seed)
    {
      filter->SetSeed(seed);
      filter->Update();
      const double escaped = Field(filter, "EscapedPower") / Field(filter, "EmittedPower");
      sum += escaped;
      squares += escaped * escaped;
      least = std::min(least, escaped);
      stated +=
        std::pow(Field(filter, "EscapedPowerStandardError") / Field(filter, "EmittedPower"), 2) /
        seeds;
      EXPECT_EQ(
        Field(filter, "EscapedPowerStandardError"), Field(filter, "AbsorbedPowerStandardError"));
    }
    const double mean = sum / seeds,
                 error = std::sqrt((squares / seeds - mean * mean) / (seeds - 1));
    double expected = 0, shotError = 0;
    if (isOpen)
    {
      const auto shot = MakeFilter(scene, 400000);
      shot->Update();
      expected = Field(shot, "EscapedPower") / Field(shot, "EmittedPower");
      shotError = std::sqrt(expected * (1 - expected) / 400000); // more than it is, for nets
    }
    std::cout << "escaped " << mean << " +- " << error << " of the power, " << expected
              << " expected\n";
    EXPECT_NEAR(mean, expected, 5 * std::hypot(error, shotError));
    EXPECT_LT(error, 0.01) << "else a test of nothing";
    EXPECT_EQ(least < 0, !isOpen);
    // The deviation of 24 seeds exceeds the true one by a half once in 10,000 (chi squared).
    EXPECT_LT(error * std::sqrt(seeds), 1.5 * std::sqrt(stated));
    EXPECT_GT(error * std::sqrt(seeds), 0.2 * std::sqrt(stated)) << "a bar of nothing";
  }
}

// Where nothing absorbs, nothing is absorbed, and where nothing reflects, no walk is shot.
TEST(DirectLight, PowersOfWhiteAndBlackScenes)
{
  const auto dyed = [](Scene scene, double reflectance) {
    for (Mesh& mesh : scene.Fixed)
    {
      mesh = Copy(mesh);
      SetCellValues(mesh, "DiffuseReflectance", { reflectance });
    }
    scene.Moving.clear();
    return scene;
  };
  const auto errors = { "AbsorbedPowerStandardError", "EscapedPowerStandardError" };
  for (const bool errorBars : { false, true })
  {
    const auto white = MakeGathered(dyed(MakeOpenScene(), 1), 4000);
    const auto black = MakeGathered(dyed(MakeSmallScene(), 0), 4000);
    for (const auto& filter : { white, black })
    {
      filter->SetComputeStandardError(errorBars);
      filter->Update();
    }
    EXPECT_GT(Field(white, "NumberOfWalks"), 1000);
    EXPECT_LT(
      std::abs(Field(white, "AbsorbedPower")), 5 * Field(white, "AbsorbedPowerStandardError"));
    EXPECT_EQ(Field(black, "NumberOfWalks"), 0);
    EXPECT_EQ(black->GetFigure("NumberOfWalks"), 0);
    EXPECT_EQ(Field(black, "NumberOfSegments"), 0);
    EXPECT_LT(
      std::abs(Field(black, "EscapedPower")), 5 * Field(black, "EscapedPowerStandardError"));
    for (const char* name : errors)
    {
      EXPECT_LT(Field(white, name), 0.05 * Field(white, "EmittedPower"));
      EXPECT_LT(Field(black, name), 0.05 * Field(black, "EmittedPower"));
    }
  }
  // Shot, nothing is estimated in a closed scene; of an open one a binomial number of walks
  // escapes.
  const auto closed = MakeFilter(MakeSmallScene(), 2000), open = MakeFilter(MakeOpenScene(), 2000);
  closed->Update();
  open->Update();
  EXPECT_EQ(Field(closed, "EscapedPowerStandardError"), 0);
  EXPECT_EQ(Field(closed, "NumberOfWalks"), 2000);
  const double escaped = Field(open, "EscapedPower") / Field(open, "EmittedPower");
  EXPECT_NEAR(Field(open, "EscapedPowerStandardError"),
    Field(open, "EmittedPower") * std::sqrt(escaped * (1 - escaped) / 2000), 1e-9);
}

// Updates have the figures of new filters, and so have several bands.
TEST(DirectLight, ErrorsOfPowersFollowMotions)
{
  for (const Scene& scene : { MakeSmallScene(), MakeGlossyScene() })
  {
    const auto filter = MakeGathered(scene, 2000);
    for (int frame = 0; frame < 3; ++frame)
    {
      filter->Update();
      const auto other = MakeGathered(scene, 2000);
      other->Update();
      for (const char* name :
        { "AbsorbedPowerStandardError", "EscapedPowerStandardError", "NumberOfWalks" })
      {
        const int bands =
          filter->GetOutput()->GetFieldData()->GetArray(name)->GetNumberOfComponents();
        for (int band = 0; band < bands; ++band)
        {
          EXPECT_EQ(Field(filter, name, band), Field(other, name, band)) << name << " " << frame;
          EXPECT_GT(Field(filter, name, band), 0);
        }
      }
      scene.Moving[0].Pose->Translate(0.1, 0.05, 0);
    }
  }
}

// Light out of nothing is said, whatever its cause, or there is none: a rug in the plane of a
// floor.
TEST(DirectLight, ExcessIsSaid)
{
  Scene scene{ { MakeRoom(2, 1), MakeRectangle({ 0.5, 0.5, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1),
                 MakePointLight({ 1, 1, 1 }, { 100 }) },
    {} };
  const auto filter = MakeGathered(scene, 100000);
  const auto observer = ErrorObserver::Watch(filter);
  filter->Update();
  const double escaped = Field(filter, "EscapedPower"),
               error = Field(filter, "EscapedPowerStandardError");
  std::cout << escaped << " +- " << error << " W escape\n";
  ASSERT_EQ(observer->Warnings.size(), escaped < -5 * error ? 1u : 0u);
  EXPECT_TRUE(observer->Warnings.empty() ||
    observer->Warnings[0].find("light comes out of nothing") != std::string::npos);
}

// Law 7: no walks are stored where nothing can move.
TEST(DirectLight, NoHistoryWithoutMotion)
{
  Scene scene = MakeSmallScene();
  const auto filter = MakeGathered(scene, 4000);
  filter->Update();
  const double stored = Field(filter, "HistoryBytes");
  EXPECT_GT(stored, 0);
  filter->SetUpdateModeToRebuild();
  filter->Update();
  const double rebuilt =
    Field(filter, "HistoryBytes"); // samples, and the sums of static and dynamic cells
  EXPECT_LT(rebuilt, 0.5 * stored);
  scene.Moving.clear();
  const auto still = MakeGathered(scene, 4000);
  still->Update();
  EXPECT_LT(Field(still, "HistoryBytes"), rebuilt) << "samples alone";
}

// Without light, without surfaces, and with nothing at all.
TEST(DirectLight, EmptyScenes)
{
  const Scene dark{ { MakeRoom(2, 1) }, { MakeMoving(MakeBall(0.2, 5), { 1, 1, 1 }) } };
  const Scene lights{ { MakePointLight({ 0, 0, 0 }, { 60 }) }, {} };
  for (const Scene& scene : { dark, lights })
  {
    const auto filter = MakeGathered(scene, 1000);
    const auto observer = ErrorObserver::Watch(filter);
    filter->Update();
    EXPECT_TRUE(observer->Errors.empty());
    EXPECT_EQ(Field(filter, "AbsorbedPower"), 0);
    EXPECT_NEAR(Field(filter, "EscapedPower"), Field(filter, "EmittedPower"), 1e-12);
  }
  vtkNew<vtkIrradianceFilter> empty;
  empty->SetDirectLightToGathered();
  const auto observer = ErrorObserver::Watch(empty);
  empty->Update();
  EXPECT_TRUE(observer->Errors.empty());
}

// A dose and its error bars, of the same walks in each replicate.
TEST(DirectLight, DosesAgree)
{
  const auto doseOf = [](int directLight) {
    const ExposureScenes::WalkThrough scene(20000);
    scene.Irradiance->SetDirectLight(directLight);
    scene.Irradiance->SetSeed(1 + directLight);
    scene.Irradiance->ComputeStandardErrorOn();
    const auto exposure = ExposureScenes::MakeExposure(scene.Irradiance);
    const auto observer = ErrorObserver::Watch(exposure);
    exposure->Update();
    EXPECT_TRUE(observer->Errors.empty());
    double sum = 0, squares = 0;
    for (vtkPolyData* leaf : LeavesOf(exposure->GetOutputDataObject(0)))
    {
      for (vtkIdType cell = 0; cell < leaf->GetNumberOfCells(); ++cell)
      {
        const double area = AreaOf(leaf, cell),
                     error = leaf->GetCellData()
                               ->GetArray("RadiantExposureStandardError")
                               ->GetComponent(cell, 0);
        sum += area * leaf->GetCellData()->GetArray("RadiantExposure")->GetComponent(cell, 0);
        squares += std::isnan(error) ? 0 : std::pow(area * error, 2);
      }
    }
    return std::array<double, 2>{ sum, std::sqrt(squares) };
  };
  const auto shot = doseOf(vtkIrradianceFilter::Shot),
             gathered = doseOf(vtkIrradianceFilter::Gathered);
  std::cout << "dose " << shot[0] << " +- " << shot[1] << " J shot, " << gathered[0] << " +- "
            << gathered[1] << " J gathered\n";
  EXPECT_GT(gathered[1], 0);
  EXPECT_NEAR(gathered[0], shot[0], 5 * std::hypot(shot[1], gathered[1]));
}
