// SPDX-License-Identifier: BSD-3-Clause
// The exposure is the integral of the irradiance over time, whatever is at the other end.

#include "ExposureScenes.h"

#include "vtkIrradianceProbeFilter.h"
#include "vtkPointDataToCellData.h"
#include "vtkSMPTools.h"
#include "vtkVertexGlyphFilter.h"

using namespace ExposureScenes;

TEST(RadiantExposure, IsTheSumOverFreshFiltersForAnyNumberOfThreads)
{
  std::vector<OutputBits> bits;
  for (const int threads : { 1, 2 })
  {
    vtkSMPTools::LocalScope(vtkSMPTools::Config{ threads }, [&] {
      const WalkThrough scene(2000);
      const auto exposure = MakeExposure(scene.Irradiance);
      exposure->Update();
      EXPECT_EQ(scene.Ball->Visits, kTimes);
      ExpectSumOverFresh(exposure, scene, kTimes);
      EXPECT_EQ(Field(scene.Irradiance, "ShootSeconds"), 0) << "only the first time was shot";
      bits.emplace_back(BlocksOf(exposure));
    });
  }
  EXPECT_TRUE(IsSame(bits[0], bits[1]));
}

TEST(RadiantExposure, HasTheSpanAskedFor)
{
  const WalkThrough scene(1000);
  const auto exposure = MakeExposure(scene.Irradiance);
  exposure->SetStartTime(0.375);
  exposure->SetEndTime(1.25);
  exposure->Update();
  const std::vector<double> times{ 0.375, 0.5, 1, 1.25 };
  ExpectSumOverFresh(exposure, scene, times);
  EXPECT_EQ(FieldOf(exposure, "StartTime"), 0.375);
  EXPECT_EQ(FieldOf(exposure, "EndTime"), 1.25);
  EXPECT_EQ(FieldOf(exposure, "NumberOfTimeSteps"), 3);

  exposure->SetIntegrationModeToUniform();
  exposure->SetNumberOfTimeSteps(2);
  exposure->Update();
  ExpectSumOverFresh(exposure, scene, { 0.375, 0.375 + 0.875 * 0.5, 1.25 });
  EXPECT_EQ(FieldOf(exposure, "NumberOfTimeSteps"), 2);
}

TEST(RadiantExposure, BelongsToNoTime)
{
  const WalkThrough scene(500);
  const auto exposure = MakeExposure(scene.Irradiance);
  exposure->Update();
  EXPECT_FALSE(
    exposure->GetOutputInformation(0)->Has(vtkStreamingDemandDrivenPipeline::TIME_STEPS()));
  EXPECT_FALSE(
    exposure->GetOutputDataObject(0)->GetInformation()->Has(vtkDataObject::DATA_TIME_STEP()));
  const auto visits = scene.Ball->Visits;
  exposure->UpdateTimeStep(0.5);
  EXPECT_EQ(scene.Ball->Visits, visits) << "computed again";
  scene.Irradiance->SetSeed(2);
  exposure->Update();
  EXPECT_EQ(scene.Ball->Visits.size(), 2 * visits.size()) << "not computed again";
}

// Of several processes, one has all cells of a vtkIrradianceFilter; the others have none.
TEST(RadiantExposure, OfOtherPiecesHasNoCells)
{
  const WalkThrough scene(1000);
  const auto exposure = MakeExposure(scene.Irradiance);
  const auto observer = ErrorObserver::Watch(exposure);
  exposure->UpdatePiece(1, 2, 0);
  EXPECT_TRUE(observer->Errors.empty());
  EXPECT_EQ(BlocksOf(exposure)->GetNumberOfCells(), 0);
  ASSERT_TRUE(ExposureOf(exposure, 0, 0));
  exposure->UpdatePiece(0, 2, 0);
  ExpectSumOverFresh(exposure, scene, kTimes);
}

// The trapezoidal rule is exact for a function that is linear between the steps.
TEST(RadiantExposure, OfALinearIrradianceIsExact)
{
  const auto square = MakeLitSquare({ 0, 1, 4 }, [](double time) { return 3 + 2 * time; });
  const auto exposure = MakeExposure(square);
  exposure->Update();
  EXPECT_EQ(SquareExposure(exposure), 3 * 4 + 4 * 4);
  exposure->SetStartTime(0.5);
  exposure->SetEndTime(2);
  exposure->Update();
  EXPECT_EQ(SquareExposure(exposure), 3 * 1.5 + (2 * 2 - 0.5 * 0.5));
  exposure->SetIntegrationModeToUniform();
  exposure->Update();
  EXPECT_NEAR(SquareExposure(exposure), 3 * 1.5 + (2 * 2 - 0.5 * 0.5), 1e-14);
}

TEST(RadiantExposure, OfAStillSceneNeedsLimits)
{
  const auto square = MakeLitSquare({}, [](double) { return 5; });
  const auto exposure = MakeExposure(square);
  exposure->SetIntegrationModeToUniform();
  ExpectWords(ErrorOf(exposure), { "StartTime", "EndTime", "nan", "no times" });
  exposure->SetStartTime(1);
  exposure->SetEndTime(3);
  exposure->Update();
  EXPECT_DOUBLE_EQ(SquareExposure(exposure), 10);
}

TEST(RadiantExposure, SumsUpEnergies)
{
  const WalkThrough scene(1000);
  const auto exposure = MakeExposure(scene.Irradiance);
  exposure->Update();
  EXPECT_NEAR(FieldOf(exposure, "EmittedEnergy"), 25 * 1.5, 1e-9);
  EXPECT_NEAR(FieldOf(exposure, "EmittedEnergy"),
    FieldOf(exposure, "AbsorbedEnergy") + FieldOf(exposure, "EscapedEnergy"), 1e-12);
  EXPECT_LT(FieldOf(exposure, "PowerBalanceError"), 1e-14);
}

// A part that is there at some times only: they alone count for the exposure, and the last of them
// gives the geometry.
TEST(RadiantExposure, OfAPartThatComesAndGoes)
{
  const auto square = PartOverTime::Make(MakeRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1),
    { 0, 1, 2, 3, 4 }, [](vtkPolyData* part, double time) {
      if (time < 1 || time > 2)
      {
        part->Initialize();
        return;
      }
      SetCellValues(part, "Irradiance", { 7 * time });
      SetCellValues(part, "When", { time });
    });
  const auto exposure = MakeExposure(square);
  exposure->Update();
  EXPECT_EQ(SquareExposure(exposure), 7 + 14);
  auto* output = vtkPolyData::SafeDownCast(exposure->GetOutputDataObject(0));
  EXPECT_EQ(output->GetNumberOfCells(), 1);
  EXPECT_EQ(output->GetCellData()->GetArray("When")->GetComponent(0, 0), 2);
  EXPECT_FALSE(output->GetCellData()->HasArray("Irradiance"));
  exposure->SetEndTime(0.5);
  exposure->SetIntegrationModeToUniform();
  ExpectWords(ErrorOf(exposure), { "no cells at any" });
}

// The same in a scene: the ball comes and goes, and the room is lit all the time.
TEST(RadiantExposure, OfASceneWhosePartComesAndGoes)
{
  const auto isThere = [](double time) { return time > 0.1 && time < 1.4; };
  WalkThrough scene(1000);
  scene.Ball->Change = [isThere](vtkPolyData* ball, double time) {
    isThere(time) ? MoveTo(ball, WalkThrough::PositionAt(time)) : ball->Initialize();
  };
  const auto exposure = MakeExposure(scene.Irradiance);
  exposure->Update();
  std::array<std::vector<double>, 2> sums;
  const double weights[] = { 0.125, 0.25, 0.375, 0.5, 0.25 };
  const auto bare = MakeFilter(MakeEmptyRoom(), scene.Walks);
  bare->Update();
  for (std::size_t i = 0; i < kTimes.size(); ++i)
  {
    const auto fresh = isThere(kTimes[i]) ? scene.FreshAt(kTimes[i]) : bare;
    for (const unsigned int port : { 0u, 1u })
    {
      if (port == 0 || isThere(kTimes[i]))
      {
        AddTimes(weights[i], IrradianceOf(fresh, port, 0), sums[port]);
      }
    }
  }
  for (const unsigned int port : { 0u, 1u })
  {
    ASSERT_FALSE(sums[port].empty());
    EXPECT_EQ(ValuesOf(ExposureOf(exposure, port, 0)), sums[port]);
  }
}

TEST(RadiantExposure, RejectsBadLimits)
{
  const auto square = MakeLitSquare({ 0.5, 1, 4 }, [](double) { return 5; });
  const auto exposure = MakeExposure(square);
  exposure->SetStartTime(0.25);
  ExpectWords(ErrorOf(exposure), { "StartTime", "0.25", "0.5 to 4" });
  exposure->SetStartTime(-std::numeric_limits<double>::infinity());
  ExpectWords(ErrorOf(exposure), { "StartTime", "-inf" });
  exposure->SetStartTime(0.5);
  exposure->SetEndTime(4.5);
  ExpectWords(ErrorOf(exposure), { "EndTime", "4.5", "0.5 to 4" });
  exposure->SetStartTime(3);
  exposure->SetEndTime(2);
  ExpectWords(ErrorOf(exposure), { "wrong way round", "StartTime is 3", "EndTime is 2" });
  exposure->SetEndTime(3.5);
  ExpectWords(ErrorOf(exposure), { "TimeSteps", "none", "3 to 3.5" });
  exposure->SetIntegrationModeToUniform();
  exposure->SetNumberOfTimeSteps(0);
  ExpectWords(ErrorOf(exposure), { "NumberOfTimeSteps", "0", "1 to 1000000" });
  exposure->SetNumberOfTimeSteps(3);
  exposure->Update();
  EXPECT_DOUBLE_EQ(SquareExposure(exposure), 2.5) << "usable afterwards";

  square->Times = { 1 };
  square->Modified();
  exposure->SetIntegrationModeToTimeSteps();
  exposure->SetStartTime(std::numeric_limits<double>::quiet_NaN());
  exposure->SetEndTime(std::numeric_limits<double>::quiet_NaN());
  ExpectWords(ErrorOf(exposure), { "1" });
}

TEST(RadiantExposure, RejectsBadInput)
{
  const auto square = MakeLitSquare({ 0, 1, 2 },
    [](double time) { return time == 1 ? std::numeric_limits<double>::quiet_NaN() : 1.0; });
  const auto exposure = MakeExposure(square);
  ExpectWords(ErrorOf(exposure), { "the input", "cell 0", "Irradiance is nan", "time 1" });

  const auto setChange = [&](const std::function<void(vtkPolyData*, double)>& change) {
    square->Change = change;
    square->Modified();
  };
  setChange([](vtkPolyData*, double) {});
  ExpectWords(ErrorOf(exposure), { "Irradiance", "connect", "vtkIrradianceFilter" });
  setChange([](vtkPolyData* part, double time) {
    if (time == 2)
    {
      part->ShallowCopy(MakeRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 2));
    }
    SetCellValues(part, "Irradiance", { 1 });
  });
  ExpectWords(ErrorOf(exposure), { "the input", "1 cells at time 1", "4 at time 2" });
  setChange([](vtkPolyData* part, double time) {
    SetCellValues(part, time > 1 ? "IrradianceFront" : "Irradiance", { 1 });
  });
  ExpectWords(ErrorOf(exposure), { "Irradiance has gone at time 2" });
  setChange([](vtkPolyData* part, double time) {
    SetCellValues(part, "Irradiance", { 1 });
    vtkNew<vtkDoubleArray> stale;
    stale->SetName("StalePower");
    stale->InsertNextValue(time);
    part->GetFieldData()->AddArray(stale);
  });
  ExpectWords(ErrorOf(exposure), { "StalePower is 1 W", "time 1", "RepairTimeBudget" });
  setChange([](vtkPolyData* part, double time) {
    SetCellValues(part, "Irradiance", { 1 });
    part->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), std::floor(time));
  });
  exposure->SetEndTime(1.5);
  ExpectWords(ErrorOf(exposure), { "time 1.5", "that of 1", "vtkTemporalInterpolator" });
  exposure->SetEndTime(2);
  exposure->Update();
  EXPECT_EQ(SquareExposure(exposure), 2) << "usable afterwards";
}

// Sensors have no cells, or ones with no irradiance of their own; the error says how they get a
// dose, and so they do.
TEST(RadiantExposure, OfSensorsTakesVertexCells)
{
  const auto light =
    MakeDefaultFilter({ { MakeRoom(2, 1), MakeLamp({ 1, 1, 1.9 }, 0.5, { 100 }) }, {} }, 2000);
  const Mesh plane = MakeRectangle({ 0.5, 0.5, 0.5 }, { 1, 0, 0 }, { 0, 1, 0 }, 2);
  const Mesh bare = Copy(plane), facing = Copy(plane);
  bare->SetPolys(nullptr);
  SetNormals(facing, { { 0, 0, 1 } });
  vtkNew<vtkIrradianceProbeFilter> probe;
  probe->SetSourceConnection(light->GetOutputPort());
  const auto exposure = MakeExposure(probe);
  exposure->SetStartTime(1);
  exposure->SetEndTime(3);
  for (const Mesh& sensors : { plane, bare, facing })
  {
    probe->SetInputData(sensors);
    for (const int mode :
      { vtkRadiantExposureFilter::Automatic, vtkRadiantExposureFilter::Uniform })
    {
      exposure->SetIntegrationMode(mode);
      ExpectWords(
        ErrorOf(exposure), { "light of points", "vtkVertexGlyphFilter", "vtkPointDataToCellData" });
    }
  }
  vtkNew<vtkVertexGlyphFilter> vertices;
  vertices->SetInputData(facing);
  probe->SetInputConnection(0, vertices->GetOutputPort());
  vtkNew<vtkPointDataToCellData> cells;
  cells->SetInputConnection(probe->GetOutputPort());
  cells->PassPointDataOn();
  exposure->SetInputConnection(cells->GetOutputPort());
  exposure->Update();
  auto* doses = vtkPolyData::SafeDownCast(exposure->GetOutputDataObject(0));
  vtkDataArray* dose = doses->GetCellData()->GetArray("RadiantExposure");
  ASSERT_NE(dose, nullptr);
  ASSERT_EQ(dose->GetNumberOfTuples(), 9);
  for (vtkIdType i = 0; i < 9; ++i)
  {
    const double irradiance = doses->GetPointData()->GetArray("Irradiance")->GetComponent(i, 0);
    EXPECT_NEAR(dose->GetComponent(i, 0), 2 * irradiance, 1e-13 * irradiance);
  }
}

// VTK's own way to visit all times would ask for ever here.
TEST(RadiantExposure, EndsIfUpstreamFails)
{
  const auto square = MakeLitSquare({ 0, 1, 2, 3 }, [](double time) { return time; });
  const auto upstream = ErrorObserver::Watch(square);
  square->FailsAt = 2;
  const auto exposure = MakeExposure(square);
  ExpectWords(ErrorOf(exposure), { "time 2", "its own error" });
  EXPECT_EQ(upstream->Errors.size(), 1u);
  square->FailsAt = std::numeric_limits<double>::quiet_NaN();
  square->Modified();
  exposure->Update();
  EXPECT_EQ(SquareExposure(exposure), 4.5);
}
