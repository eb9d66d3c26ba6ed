// SPDX-License-Identifier: BSD-3-Clause
// The exposure is the integral of the irradiance over time, whatever is at the other end.

#include "ErrorObserver.h"
#include "OutputBits.h"
#include "PartOverTime.h"
#include "TestScenes.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkRadiantExposureFilter.h"
#include "vtkSMPTools.h"
#include "vtkTransformInterpolator.h"

#include <gtest/gtest.h>

#include <cstring>

using namespace TestScenes;

namespace
{

using Exposure = vtkSmartPointer<vtkRadiantExposureFilter>;

const std::vector<double> kTimes{ 0, 0.25, 0.5, 1, 1.5 }; // intervals differ

Exposure MakeExposure(vtkAlgorithm* input)
{
  auto exposure = Exposure::New();
  exposure->SetInputConnection(input->GetOutputPort());
  return exposure;
}

/// A ball that walks through the small room, and the filter behind it.
struct WalkThrough
{
  explicit WalkThrough(vtkIdType walks)
    : Walks(walks)
    , Ball(PartOverTime::Make(MakeBall(0.3, 6), kTimes,
        [](vtkPolyData* ball, double time) { MoveTo(ball, PositionAt(time)); }))
    , Irradiance(MakeFilter(Room(), walks))
  {
    this->Irradiance->AddInputConnection(1, this->Ball->GetOutputPort());
  }

  static Vector PositionAt(double time) { return { 0.6 + time, 1.2, 1 + 0.5 * time }; }
  static Scene Room()
  {
    return { { MakeRoom(3, 2), MakeLamp({ 1.5, 1.5, 2.9 }, 0.5, { 100 }) }, {} };
  }
  /// What a new filter finds at a time.
  vtkSmartPointer<vtkIrradianceFilter> FreshAt(double time) const
  {
    Scene scene = Room();
    scene.Moving.push_back(MakeMoving(this->Ball->Model, PositionAt(time)));
    auto fresh = MakeFilter(scene, this->Walks);
    fresh->Update();
    return fresh;
  }

  vtkIdType Walks;
  vtkSmartPointer<PartOverTime> Ball;
  vtkSmartPointer<vtkIrradianceFilter> Irradiance;
};

vtkMultiBlockDataSet* BlocksOf(vtkRadiantExposureFilter* exposure)
{
  return vtkMultiBlockDataSet::SafeDownCast(exposure->GetOutputDataObject(0));
}

vtkDataArray* ExposureOf(vtkRadiantExposureFilter* exposure, unsigned int port, unsigned int i)
{
  return OutputOf(BlocksOf(exposure), port, i)->GetCellData()->GetArray("RadiantExposure");
}

double FieldOf(vtkRadiantExposureFilter* exposure, const char* name)
{
  return exposure->GetOutputDataObject(0)->GetFieldData()->GetArray(name)->GetComponent(0, 0);
}

/// The law: the bits of a sum over new filters, in the order of time.
void ExpectSumOverFresh(
  vtkRadiantExposureFilter* exposure, const WalkThrough& scene, const std::vector<double>& times)
{
  for (const unsigned int port : { 0u, 1u })
  {
    vtkDataArray* exposed = ExposureOf(exposure, port, 0);
    ASSERT_TRUE(exposed);
    std::vector<double> sum(static_cast<std::size_t>(exposed->GetNumberOfValues()));
    for (std::size_t i = 0; i < times.size(); ++i)
    {
      const double before = times[i == 0 ? i : i - 1],
                   after = times[std::min(i + 1, times.size() - 1)];
      const auto fresh = scene.FreshAt(times[i]);
      for (std::size_t cell = 0; cell < sum.size(); ++cell)
      {
        sum[cell] += 0.5 * (after - before) *
          IrradianceOf(fresh, port, 0)->GetComponent(static_cast<vtkIdType>(cell), 0);
      }
    }
    ASSERT_GT(sum[0], 0);
    EXPECT_EQ(std::memcmp(sum.data(), exposed->GetVoidPointer(0), sum.size() * sizeof(double)), 0);
  }
}

/// A square of one cell with an irradiance that a function of time gives.
vtkSmartPointer<PartOverTime> MakeLitSquare(
  const std::vector<double>& times, const std::function<double(double)>& irradiance)
{
  return PartOverTime::Make(MakeRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1), times,
    [irradiance](vtkPolyData* square, double time) {
      SetCellValues(square, "Irradiance", { irradiance(time) });
    });
}

double SquareExposure(vtkRadiantExposureFilter* exposure)
{
  auto* square = vtkPolyData::SafeDownCast(exposure->GetOutputDataObject(0));
  return square->GetCellData()->GetArray("RadiantExposure")->GetComponent(0, 0);
}

/// The only error of an update, after which the output is empty.
std::string ErrorOf(vtkRadiantExposureFilter* exposure)
{
  const auto observer = ErrorObserver::Watch(exposure);
  exposure->Modified();
  exposure->Update();
  EXPECT_EQ(observer->Errors.size(), 1u);
  vtkDataObject* output = exposure->GetOutputDataObject(0);
  EXPECT_EQ(output->GetNumberOfElements(vtkDataObject::CELL), 0);
  EXPECT_EQ(output->GetFieldData()->GetNumberOfArrays(), 0);
  exposure->RemoveObserver(observer);
  exposure->GetExecutive()->RemoveObserver(observer);
  return observer->Errors.empty() ? "" : observer->Errors[0];
}

void ExpectWords(const std::string& text, const std::vector<std::string>& words)
{
  for (const std::string& word : words)
  {
    EXPECT_NE(text.find(word), std::string::npos) << "\"" << word << "\" is not in: " << text;
  }
}

}

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

// A part that is there at some times only; the exposure is that of those times, and the geometry that
// of the last of them.
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
    if (isThere(time))
    {
      MoveTo(ball, WalkThrough::PositionAt(time));
    }
    else
    {
      ball->Initialize();
    }
  };
  const auto exposure = MakeExposure(scene.Irradiance);
  exposure->Update();
  std::vector<double> room(24),
    ball(static_cast<std::size_t>(scene.Ball->Model->GetNumberOfCells()));
  const std::vector<double> weights{ 0.125, 0.25, 0.375, 0.5, 0.25 };
  const auto bare = MakeFilter(WalkThrough::Room(), scene.Walks);
  bare->Update();
  for (std::size_t i = 0; i < kTimes.size(); ++i)
  {
    const auto fresh = isThere(kTimes[i]) ? scene.FreshAt(kTimes[i]) : bare;
    const auto add = [&](std::vector<double>& sum, unsigned int port) {
      for (std::size_t cell = 0; cell < sum.size(); ++cell)
      {
        sum[cell] +=
          weights[i] * IrradianceOf(fresh, port, 0)->GetComponent(static_cast<vtkIdType>(cell), 0);
      }
    };
    add(room, 0);
    if (isThere(kTimes[i]))
    {
      add(ball, 1);
    }
  }
  EXPECT_EQ(
    std::memcmp(room.data(), ExposureOf(exposure, 0, 0)->GetVoidPointer(0), room.size() * 8), 0);
  ASSERT_EQ(
    OutputOf(BlocksOf(exposure), 1, 0)->GetNumberOfCells(), static_cast<vtkIdType>(ball.size()));
  EXPECT_EQ(
    std::memcmp(ball.data(), ExposureOf(exposure, 1, 0)->GetVoidPointer(0), ball.size() * 8), 0);
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

namespace
{

/// Aborts at the n-th progress event of each update, until it is told to let be.
class Aborter : public vtkCommand
{
public:
  static Aborter* New() { return new Aborter; }
  void Execute(vtkObject* caller, unsigned long, void* progress) override
  {
    this->Progress.push_back(*static_cast<double*>(progress));
    if (this->Events > 0 && --this->Events == 0)
    {
      static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
    }
  }
  int Events = 0;
  std::vector<double> Progress;
};

}

TEST(RadiantExposure, ContinuesAfterAnAbort)
{
  const WalkThrough scene(1000);
  const auto exposure = MakeExposure(scene.Irradiance);
  vtkNew<Aborter> aborter;
  exposure->AddObserver(vtkCommand::ProgressEvent, aborter);
  const auto abortedUpdate = [&] {
    aborter->Events = 3; // the first event comes before anything is done
    exposure->Modified();
    exposure->Update();
    EXPECT_EQ(BlocksOf(exposure)->GetNumberOfBlocks(), 0u);
  };
  abortedUpdate();
  EXPECT_EQ(scene.Ball->Visits.size(), 2u);
  abortedUpdate();
  EXPECT_EQ(scene.Ball->Visits.size(), 4u);
  exposure->Modified();
  exposure->Update();
  EXPECT_EQ(scene.Ball->Visits, kTimes) << "every time once";
  ExpectSumOverFresh(exposure, scene, kTimes);

  // What matters has changed, so all times are visited again.
  const auto expectAnew = [&](const std::vector<double>& times) {
    scene.Ball->Visits.clear();
    exposure->Modified();
    exposure->Update();
    EXPECT_EQ(scene.Ball->Visits, times);
    ExpectSumOverFresh(exposure, scene, times);
  };
  abortedUpdate();
  exposure->SetEndTime(1);
  expectAnew({ 0, 0.25, 0.5, 1 });
  exposure->SetEndTime(1.5);
  abortedUpdate();
  scene.Irradiance->SetSeed(3);
  scene.Irradiance->SetSeed(1);
  expectAnew(kTimes);
}

namespace
{

/// Aborts the n-th execution from when it is told so.
class ExecutionAborter : public vtkCommand
{
public:
  static ExecutionAborter* New() { return new ExecutionAborter; }
  void Execute(vtkObject* caller, unsigned long event, void*) override
  {
    if (event == vtkCommand::StartEvent)
    {
      ++this->Starts;
      --this->Executions;
    }
    else if (this->Executions == 0)
    {
      static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
    }
  }
  int Executions = 0;
  int Starts = 0;
};

}

// The user aborts the long first shooting, or an update, where its progress is seen.
TEST(RadiantExposure, ContinuesAfterAnAbortUpstream)
{
  const WalkThrough scene(1000);
  const auto exposure = MakeExposure(scene.Irradiance);
  const auto observer = ErrorObserver::Watch(exposure);
  vtkNew<ExecutionAborter> aborter;
  scene.Irradiance->AddObserver(vtkCommand::StartEvent, aborter);
  scene.Irradiance->AddObserver(vtkCommand::ProgressEvent, aborter);
  for (const int execution : { 1, 3, 0 })
  {
    aborter->Executions = execution;
    exposure->Modified();
    exposure->Update();
    EXPECT_EQ(BlocksOf(exposure)->GetNumberOfBlocks(), execution == 0 ? 2u : 0u);
  }
  EXPECT_TRUE(observer->Errors.empty() && observer->Warnings.empty());
  ExpectSumOverFresh(exposure, scene, kTimes);
  EXPECT_EQ(aborter->Starts, static_cast<int>(kTimes.size()) + 2) << "two were aborted";
}

// An interpolator sets itself up when it is first asked; that is no change of the scene.
TEST(RadiantExposure, OfAnInterpolatorContinuesToo)
{
  const auto make = [] {
    auto irradiance = MakeFilter(WalkThrough::Room(), 1000);
    vtkNew<vtkTransformInterpolator> way;
    for (int key = 0; key < 3; ++key)
    {
      vtkNew<vtkTransform> pose;
      pose->Translate(0.6 + 0.5 * key, 1.2 + 0.1 * key * key, 1);
      way->AddTransform(key, pose);
    }
    irradiance->AddInputDataObject(1, MakeBall(0.3, 6));
    irradiance->SetDynamicTransformInterpolator(0, way);
    return irradiance;
  };
  const auto irradiance = make(), other = make();
  const auto exposure = MakeExposure(irradiance), whole = MakeExposure(other);
  const auto observer = ErrorObserver::Watch(exposure);
  vtkNew<Aborter> aborter;
  exposure->AddObserver(vtkCommand::ProgressEvent, aborter);
  int updates = 0;
  vtkNew<vtkCallbackCommand> counter;
  counter->SetClientData(&updates);
  counter->SetCallback(
    [](vtkObject*, unsigned long, void* count, void*) { ++*static_cast<int*>(count); });
  irradiance->AddObserver(vtkCommand::EndEvent, counter);
  for (vtkRadiantExposureFilter* filter : { exposure.Get(), whole.Get() })
  {
    filter->SetIntegrationModeToUniform();
    filter->SetNumberOfTimeSteps(5);
  }
  aborter->Events = 4;
  exposure->Update();
  EXPECT_EQ(BlocksOf(exposure)->GetNumberOfBlocks(), 0u);
  exposure->Modified();
  exposure->Update();
  EXPECT_EQ(updates, 6) << "every time once";
  whole->Update();
  EXPECT_TRUE(IsSame(OutputBits(BlocksOf(exposure)), OutputBits(BlocksOf(whole))));
  EXPECT_TRUE(observer->Warnings.empty() && observer->Errors.empty());
}

TEST(RadiantExposure, ReportsProgress)
{
  const auto square = MakeLitSquare({ 0, 1, 2, 3 }, [](double time) { return time; });
  const auto exposure = MakeExposure(square);
  vtkNew<Aborter> observer;
  exposure->AddObserver(vtkCommand::ProgressEvent, observer);
  exposure->Update();
  EXPECT_EQ(observer->Progress, (std::vector<double>{ 0, 0.25, 0.5, 0.75, 1 }));
}

// An observer changes the scene during the run: what was summed up is of no use.
TEST(RadiantExposure, StartsAgainIfSomethingChangesMeanwhile)
{
  const auto square = MakeLitSquare({ 0, 1, 2, 3 }, [](double time) { return time; });
  const auto exposure = MakeExposure(square);
  struct Changer : vtkCommand
  {
    static Changer* New() { return new Changer; }
    void Execute(vtkObject*, unsigned long, void* progress) override
    {
      if (*static_cast<double*>(progress) == 0.5 && !this->IsDone)
      {
        this->IsDone = true;
        this->Square->Change = [](vtkPolyData* part, double) {
          SetCellValues(part, "Irradiance", { 10 });
        };
        this->Square->Modified();
      }
    }
    PartOverTime* Square = nullptr;
    bool IsDone = false;
  };
  vtkNew<Changer> changer;
  changer->Square = square;
  exposure->AddObserver(vtkCommand::ProgressEvent, changer);
  exposure->Update();
  EXPECT_TRUE(changer->IsDone);
  EXPECT_EQ(SquareExposure(exposure), 30);
}

namespace
{

std::vector<double> IntegrationTimesOf(vtkRadiantExposureFilter* exposure)
{
  vtkDataArray* times =
    exposure->GetOutputDataObject(0)->GetFieldData()->GetArray("IntegrationTimes");
  std::vector<double> values;
  for (vtkIdType i = 0; i < times->GetNumberOfTuples(); ++i)
  {
    values.push_back(times->GetComponent(i, 0));
  }
  return values;
}

}

TEST(ErrorControlledExposure, IsTheSumOverFreshFiltersAndContinues)
{
  const WalkThrough scene(1000);
  const auto exposure = MakeExposure(scene.Irradiance);
  exposure->SetIntegrationModeToErrorControlled();
  exposure->SetNumberOfTimeSteps(2);
  exposure->SetRelativeTolerance(0.1);
  exposure->Update();
  const std::vector<double> times = IntegrationTimesOf(exposure), visits = scene.Ball->Visits;
  EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
  EXPECT_GT(times.size(), 5u);
  EXPECT_EQ(
    std::set<double>(visits.begin(), visits.end()), std::set<double>(times.begin(), times.end()));
  EXPECT_EQ(visits.size(), times.size()) << "every time once";
  EXPECT_EQ(FieldOf(exposure, "NumberOfTimeSteps"), static_cast<double>(times.size() - 1));
  EXPECT_LE(FieldOf(exposure, "TimeIntegrationError"), 0.1);
  ExpectSumOverFresh(exposure, scene, times);

  const OutputBits bits(BlocksOf(exposure));
  scene.Ball->Visits.clear();
  vtkNew<Aborter> aborter;
  exposure->AddObserver(vtkCommand::ProgressEvent, aborter);
  for (const int events : { 3, 4, 0 }) // first among the first intervals, then while halving
  {
    aborter->Events = events;
    exposure->Modified();
    exposure->Update();
  }
  EXPECT_EQ(scene.Ball->Visits, visits);
  EXPECT_TRUE(IsSame(bits, OutputBits(BlocksOf(exposure))));
}

// A lamp that passes: the error is within the tolerance, with the more times the smaller that is, and
// most of them where the irradiance changes.
TEST(ErrorControlledExposure, ReachesItsTolerance)
{
  const auto square =
    MakeLitSquare({ 0, 10 }, [](double time) { return 1 / (1 + std::pow((time - 3) / 0.3, 2)); });
  const double exact = 0.3 * (std::atan(7 / 0.3) + std::atan(3 / 0.3));
  const auto exposure = MakeExposure(square);
  exposure->SetIntegrationModeToErrorControlled();
  std::size_t fewer = 0;
  for (const double tolerance : { 0.1, 0.01, 0.001 })
  {
    exposure->SetRelativeTolerance(tolerance);
    exposure->SetNumberOfTimeSteps(10);
    exposure->Update();
    EXPECT_NEAR(SquareExposure(exposure), exact, tolerance * exact);
    EXPECT_LE(FieldOf(exposure, "TimeIntegrationError"), tolerance);
    EXPECT_GE(FieldOf(exposure, "TimeIntegrationError") * exact,
      std::abs(SquareExposure(exposure) - exact));
    const auto times = IntegrationTimesOf(exposure);
    EXPECT_GT(times.size(), fewer);
    fewer = times.size();
    if (tolerance == 0.001)
    {
      const auto inPeak =
        std::count_if(times.begin(), times.end(), [](double time) { return time > 2 && time < 4; });
      std::cout << times.size() << " times, of which " << inPeak << " in a fifth of the span\n";
      EXPECT_GT(2 * static_cast<std::size_t>(inPeak), times.size());
    }
  }
}

// A part that appears. Each halving halves the error, so it is within any tolerance after some.
TEST(ErrorControlledExposure, EndsAtAJump)
{
  const auto square = PartOverTime::Make(MakeRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1),
    { 0, 1 }, [](vtkPolyData* part, double time) {
      if (time < 1.0 / 3)
      {
        part->Initialize();
        return;
      }
      SetCellValues(part, "Irradiance", { 3 });
    });
  const auto exposure = MakeExposure(square);
  const auto observer = ErrorObserver::Watch(exposure);
  exposure->SetIntegrationModeToErrorControlled();
  exposure->SetNumberOfTimeSteps(2);
  exposure->SetRelativeTolerance(1e-4);
  exposure->Update();
  EXPECT_NEAR(SquareExposure(exposure), 2, 1e-4 * 2);
  EXPECT_LT(FieldOf(exposure, "NumberOfTimeSteps"), 40);
  EXPECT_TRUE(observer->Warnings.empty());

  exposure->SetMaximumNumberOfTimeSteps(10);
  exposure->Update();
  EXPECT_LE(FieldOf(exposure, "NumberOfTimeSteps"), 10);
  ASSERT_EQ(observer->Warnings.size(), 1u);
  ExpectWords(observer->Warnings[0],
    { "RelativeTolerance 0.0001", "MaximumNumberOfTimeSteps 10", "the input: 0.0" });
  EXPECT_GT(FieldOf(exposure, "TimeIntegrationError"), 1e-4);
  EXPECT_NEAR(SquareExposure(exposure), 2, 2 * FieldOf(exposure, "TimeIntegrationError"));
}

TEST(ErrorControlledExposure, RejectsBadSettings)
{
  const auto square = MakeLitSquare({ 0, 1 }, [](double) { return 5; });
  const auto exposure = MakeExposure(square);
  exposure->SetIntegrationModeToErrorControlled();
  exposure->SetRelativeTolerance(0);
  ExpectWords(ErrorOf(exposure), { "RelativeTolerance is 0" });
  exposure->SetRelativeTolerance(std::nan(""));
  ExpectWords(ErrorOf(exposure), { "RelativeTolerance is nan" });
  exposure->SetRelativeTolerance(0.1);
  exposure->SetMaximumNumberOfTimeSteps(39);
  ExpectWords(ErrorOf(exposure), { "MaximumNumberOfTimeSteps is 39", "40" });
  exposure->SetMaximumNumberOfTimeSteps(40);
  exposure->Update();
  EXPECT_DOUBLE_EQ(SquareExposure(exposure), 5);
  EXPECT_EQ(FieldOf(exposure, "NumberOfTimeSteps"), 40);
}
