// SPDX-License-Identifier: BSD-3-Clause
// Direct light, shot or gathered, as the user of the filter sees it.

#include "ErrorObserver.h"
#include "ExposureScenes.h"
#include "OutputBits.h"
#include "OutputChecks.h"
#include "TestScenes.h"
#include "ViewFilters.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

using namespace TestScenes;
using OutputChecks::AreaOf;
using OutputChecks::LeavesOf;

namespace
{

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
  std::vector<Vector> positions, normals;
  for (int i = 0; i < 40; ++i)
  {
    positions.push_back({ 0.2 + 0.3 * (i % 8), 0.3 + 0.5 * (i / 8), i % 3 == 0 ? 1.1 : 0 });
    normals.push_back({ 0, i % 3 == 0 ? 0.5 : 0, 1 });
  }
  view.Sensors = MakeSensors(positions, normals);
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
      const std::vector<double> values = ValuesOf(IrradianceOf(filter, 0, 0));
      sum.resize(values.size());
      squares.resize(values.size());
      for (std::size_t i = 0; i < values.size(); ++i)
      {
        sum[i] += values[i];
        squares[i] += values[i] * values[i];
      }
    }
    double variance = 0;
    for (std::size_t i = 0; i < sum.size(); ++i)
    {
      variance += (squares[i] - sum[i] * sum[i] / seeds) / (seeds - 1);
    }
    return std::sqrt(variance);
  };
  EXPECT_LT(noiseOf(vtkIrradianceFilter::Gathered), noiseOf(vtkIrradianceFilter::Shot) / 1.4);
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
    ASSERT_TRUE(UpdatesLike(updated, MakeGathered(scene, 3000))) << "y " << y;
    EXPECT_EQ(Field(updated, "ShootSeconds"), 0);
  }
}

namespace
{

/// The means over some seeds of what a filter gives as one number, and their standard errors.
struct SeedMean
{
  static constexpr int Seeds = 24;
  double Mean = 0, Error = 0;

  template <class Measure>
  SeedMean(vtkIrradianceFilter* filter, int firstSeed, const Measure& measure)
  {
    double squares = 0;
    for (int i = 0; i < Seeds; ++i)
    {
      filter->SetSeed(firstSeed + i);
      const double value = measure();
      this->Mean += value / Seeds;
      squares += value * value / Seeds;
    }
    this->Error = std::sqrt((squares - this->Mean * this->Mean) / (Seeds - 1));
  }
};

/// Of two means with 23 degrees of freedom each: by chance once in 20,000.
void ExpectSameMean(const SeedMean& shot, const SeedMean& gathered, double within)
{
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
    ASSERT_TRUE(UpdatesLike(updated, MakeGathered(scene, 3000))) << "reflectance " << reflectance;
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
        const double expected = watts[static_cast<std::size_t>(band)];
        EXPECT_NEAR(Field(filter, "EmittedPower", band), expected, 1e-6 * expected);
      }
      OutputChecks::ExpectBalance(filter);
      EXPECT_EQ(OutputChecks::MostStale(filter), 0);
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
    double least = 1e9, stated = 0;
    const SeedMean escaped(filter, 1, [&] {
      filter->Update();
      const double emitted = Field(filter, "EmittedPower"),
                   value = Field(filter, "EscapedPower") / emitted,
                   error = Field(filter, "EscapedPowerStandardError");
      least = std::min(least, value);
      stated += std::pow(error / emitted, 2) / SeedMean::Seeds;
      EXPECT_EQ(error, Field(filter, "AbsorbedPowerStandardError"));
      return value;
    });
    double expected = 0, shotError = 0;
    if (isOpen)
    {
      const auto shot = MakeFilter(scene, 400000);
      shot->Update();
      expected = Field(shot, "EscapedPower") / Field(shot, "EmittedPower");
      shotError = std::sqrt(expected * (1 - expected) / 400000); // more than it is, for nets
    }
    EXPECT_NEAR(escaped.Mean, expected, 5 * std::hypot(escaped.Error, shotError));
    EXPECT_LT(escaped.Error, 0.01) << "else a test of nothing";
    EXPECT_EQ(least < 0, !isOpen);
    // The deviation of 24 seeds exceeds the true one by a half once in 10,000 (chi squared).
    const double scatter = escaped.Error * std::sqrt(SeedMean::Seeds);
    EXPECT_LT(scatter, 1.5 * std::sqrt(stated));
    EXPECT_GT(scatter, 0.2 * std::sqrt(stated)) << "a bar of nothing";
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
  EXPECT_GT(gathered[1], 0);
  EXPECT_NEAR(gathered[0], shot[0], 5 * std::hypot(shot[1], gathered[1]));
}

namespace
{

/// Shoots and gathers the light of a scene, which must agree.
///
/// The squared distance of a cell in units of its error has the mean n / (n - 2) and, over cells,
/// about the variance 2 n^2 (n - 1) / ((n - 2)^2 (n - 4)), for n >= 63 degrees of freedom. The sum
/// is off by 5 of its standard deviations once in 10^6, with cells that know of each other perhaps
/// once in 10^4; nets make it smaller.
void ExpectAgreement(const Scene& scene, bool sides)
{
  const auto make = [&](int seed) {
    const auto filter = MakeFilter(scene, 200000);
    filter->SetSeed(seed);
    filter->SetSeparateSides(sides);
    filter->ComputeStandardErrorOn();
    filter->SetNumberOfReplicates(64);
    return filter;
  };
  const auto shot = make(1), gathered = make(2);
  gathered->SetDirectLightToGathered();
  shot->Update();
  gathered->Update();
  const auto ofShot = LeavesOf(shot->GetOutput()), ofGathered = LeavesOf(gathered->GetOutput());
  double squares = 0, cells = 0, errorPart = 0, power = 0; // of those whose errors are known
  for (std::size_t leaf = 0; leaf < ofShot.size(); ++leaf)
  {
    for (const std::string& side : OutputChecks::SidesOf(shot))
    {
      const auto valuesOf = [&](vtkPolyData* data, const char* suffix) {
        return ValuesOf(data->GetCellData()->GetArray(("Irradiance" + side + suffix).c_str()));
      };
      const auto a = valuesOf(ofGathered[leaf], ""), b = valuesOf(ofShot[leaf], ""),
                 errorsOfA = valuesOf(ofGathered[leaf], "StandardError"),
                 errorsOfB = valuesOf(ofShot[leaf], "StandardError");
      for (std::size_t i = 0; i < a.size(); ++i)
      {
        const double variance = std::pow(errorsOfA[i], 2) + std::pow(errorsOfB[i], 2);
        if (variance > 0)
        {
          const std::size_t bands = a.size() / std::size_t(ofShot[leaf]->GetNumberOfCells());
          const double area = AreaOf(ofShot[leaf], vtkIdType(i / bands));
          squares += std::pow(a[i] - b[i], 2) / variance;
          errorPart += std::sqrt(variance) * area;
          power += b[i] * area;
          ++cells;
        }
      }
    }
  }
  constexpr double n = 63, mean = n / (n - 2);
  const double sigma = mean * std::sqrt(2 * (n - 1) / (n - 4) * cells);
  EXPECT_GT(cells, 50);
  EXPECT_LT(squares, mean * cells + 5 * sigma);
  EXPECT_GT(squares, 0.3 * cells) << "the errors are too large";
  EXPECT_LT(errorPart, 0.05 * power) << "else a test of nothing";
}

/// Each cell at random, in each band.
void SetRandomValues(
  vtkPolyData* mesh, const char* name, int bands, double low, double high, RandomNumbers& random)
{
  SetCellValues(mesh, name, std::vector<double>(static_cast<std::size_t>(bands)));
  vtkDataArray* values = mesh->GetCellData()->GetArray(name);
  for (vtkIdType cell = 0; cell < values->GetNumberOfTuples(); ++cell)
  {
    for (int band = 0; band < bands; ++band)
    {
      values->SetComponent(cell, band, random.Between(low, high));
    }
  }
}

}

TEST(DirectLightAgreement, OfPlainScenes)
{
  ExpectAgreement(MakeSmallScene(), false);
  ExpectAgreement(MakeGlossyScene(), true);
  ExpectAgreement(MakeOpenScene(), true);
}

// Of two faces in the same place one receives what comes from afar, and each what the other sends.
TEST(DirectLightAgreement, WhereThingsTouch)
{
  ExpectAgreement(MakeTouchingScene(), true);
}

// As many lights as a table has, of fluxes from 1 to 100; some hang so near the ceiling that they
// light little else.
TEST(DirectLightAgreement, AHundredLights)
{
  RandomNumbers random(5);
  Scene scene{ { MakeRoom(4, 4) }, { MakeMoving(MakeBall(0.5, 8), { 2, 2, 1 }) } };
  for (int i = 0; i < 100; ++i)
  {
    const double x = random.Between(0.2, 3.8), y = random.Between(0.2, 3.8),
                 z = random.Between(2, 3.9), flux = std::pow(10, random.Between(0, 2));
    scene.Fixed.push_back(i % 2 == 0 ? MakePointLight({ x, y, z }, { flux })
                                     : MakeLamp({ x, y, z }, 0.1, { 100 * flux }));
  }
  ExpectAgreement(scene, false);
}

// A strip of 5.6 m under a shelf; both sides of the shelf.
TEST(DirectLightAgreement, ALongStrip)
{
  const Mesh strip = MakeRectangle({ 0.2, 0.6, 2 }, { 0, 0.05, 0 }, { 5.6, 0, 0 }, 1);
  SetCellValues(strip, "RadiantExitance", { 200 });
  const Mesh shelf = MakeRectangle({ 0, 0, 2.1 }, { 6, 0, 0 }, { 0, 1.2, 0 }, 4);
  ExpectAgreement(
    { { MakeRoom(6, 4), strip, shelf }, { MakeMoving(MakeBox(1, 1, 1), { 3, 1, 1 }) } }, true);
}

// Balls and boxes in each other, in walls, and one of them around a light.
TEST(DirectLightAgreement, ThingsInsideEachOther)
{
  ExpectAgreement({ { MakeRoom(3, 3), MakeLamp({ 1.5, 1.5, 2.9 }, 0.6, { 100 }),
                      MakePointLight({ 2.2, 2.2, 1 }, { 30 }) },
                    { MakeMoving(MakeBall(0.5, 8), { 1, 1, 1 }),
                      MakeMoving(MakeBox(0.8, 0.5, 0.6), { 1.3, 1.1, 1.1 }),
                      MakeMoving(MakeBall(0.6, 8), { 0, 2, 0.4 }),
                      MakeMoving(MakeBox(0.5, 0.5, 0.5), { 2.2, 2.2, 1 }) } },
    true);
}

// A texture: in three bands each cell reflects otherwise, some specularly, and so do the things.
TEST(DirectLightAgreement, ATextureOfReflectances)
{
  RandomNumbers random(6);
  Mesh room = MakeRoom(3, 5), ball = MakeBall(0.5, 10);
  for (const Mesh& mesh : { room, ball })
  {
    SetRandomValues(mesh, "DiffuseReflectance", 3, 0, 0.6, random);
    SetRandomValues(mesh, "SpecularReflectance", 3, 0, 0.4, random);
    SetRandomValues(mesh, "PhongExponent", 1, 0, 50, random);
  }
  ExpectAgreement({ { room, MakeLamp({ 1, 1, 2.5 }, 0.7, { 30, 100, 10 }),
                      MakeLamp({ 2, 2.5, 2.7 }, 0.3, { 200, 0, 50 }) },
                    { MakeMoving(ball, { 1.6, 1.2, 1 }) } },
    false);
}

// Point lights in a corner, in a wall, on the edge of a table, and near a ball.
TEST(DirectLightAgreement, PointLightsWhereTheyTouch)
{
  const Mesh table = MakeRectangle({ 1, 1, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, 3);
  ExpectAgreement(
    { { MakeRoom(3, 3), table, MakePointLight({ 0, 0, 3 }, { 10 }),
        MakePointLight({ 1.2, 0, 1.5 }, { 20 }), MakePointLight({ 2, 1.5, 1.5 }, { 20 }) },
      { MakeMoving(MakeBall(0.3, 8), { 2.3, 1.5, 1.5 }) } },
    true);
}

// A floor and a lamp as long as a hall of 100 m, of few cells, and things in it that are small
// beside them.
TEST(DirectLightAgreement, SmallThingsInALongHall)
{
  const auto floorOf = [](double z, double width, double direction) {
    return MakeRectangle(
      { 0, -0.5 * width * direction, z }, { 100, 0, 0 }, { 0, width * direction, 0 }, 4);
  };
  const Mesh lamp = floorOf(4, 0.2, -1);
  SetCellValues(lamp, "RadiantExitance", { 50 });
  ExpectAgreement(
    { { floorOf(0, 6, 1), floorOf(4.2, 6, -1), lamp },
      { MakeMoving(MakeBox(8, 1, 1), { 50, 0, 0.5 }), MakeMoving(MakeBox(6, 2, 0.02), { 30, 0, 1 }),
        MakeMoving(MakeBox(2, 5, 1), { 70, 0, 1 }) } },
    true);
}
