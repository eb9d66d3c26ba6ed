// SPDX-License-Identifier: BSD-3-Clause
// Under mpirun: processes share the times of a dose, and each has the bits of one alone, or one
// error.

#include "ExposureScenes.h"
#include "Processes.h"

#include "vtkAppendFilter.h"
#include "vtkCharArray.h"
#include "vtkCommunicator.h"
#include "vtkIdList.h"
#include "vtkStringArray.h"

#include <cmath>
#include <functional>
#include <limits>

using namespace ExposureScenes;
using Processes::Controller;
using Processes::IsLast;

namespace
{

/// What a process visits of times that are known in advance.
std::vector<double> ShareOf(const std::vector<double>& times, int process)
{
  std::vector<double> share;
  for (auto i = static_cast<std::size_t>(process); i < times.size();
       i += static_cast<std::size_t>(Processes::Count()))
  {
    share.push_back(times[i]);
  }
  return share;
}

/// A walk through the room in which a second ball comes at times and a third one never, and its
/// dose.
struct Walk
{
  Walk()
  {
    this->Scene.Irradiance->AddInputConnection(1, this->Guest->GetOutputPort());
    this->Scene.Irradiance->AddInputConnection(1, this->Absent->GetOutputPort());
    this->Scene.Irradiance->SetController(nullptr);
  }

  static vtkSmartPointer<PartOverTime> MakeBallIf(const std::function<bool(double)>& isThere)
  {
    return PartOverTime::Make(MakeBall(0.2, 5), kTimes, [isThere](vtkPolyData* ball, double time) {
      isThere(time) ? MoveTo(ball, { 2.2, 0.5 + time, 1 }) : ball->Initialize();
    });
  }

  WalkThrough Scene{ 1500 };
  vtkSmartPointer<PartOverTime> Guest =
    MakeBallIf([](double time) { return time > 0.1 && time < 0.9; });
  vtkSmartPointer<PartOverTime> Absent = MakeBallIf([](double) { return false; });
  Exposure Dose = MakeExposure(Scene.Irradiance);
};

using Settings = std::function<void(Walk&)>;

/// The times that this process visits, after its dose has the bits of one alone.
std::vector<double> VisitsOfSameBits(const Settings& set)
{
  Walk shared, alone;
  set(shared);
  set(alone);
  alone.Scene.Irradiance->SetController(nullptr);
  shared.Dose->SetController(Controller);
  shared.Dose->Update();
  alone.Dose->Update();
  const OutputBits bits(BlocksOf(shared.Dose));
  EXPECT_FALSE(bits.IsEmpty());
  EXPECT_TRUE(IsSame(bits, OutputBits(BlocksOf(alone.Dose))));
  EXPECT_EQ(IntegrationTimesOf(shared.Dose), IntegrationTimesOf(alone.Dose));
  return shared.Scene.Ball->Visits;
}

/// Updates, and expects one error on each process, with these words on the last and on the others.
void ExpectError(
  vtkRadiantExposureFilter* dose, const std::string& ofLast, const std::string& ofOthers)
{
  ExpectWords(ErrorOf(dose), { IsLast() ? ofLast : ofOthers });
}

const char* const Stopped = "failed or was stopped, so this one stopped too";

/// After an error all can begin again.
void ExpectWell(Walk& walk)
{
  Walk alone;
  alone.Dose->Update();
  const auto observer = ErrorObserver::Watch(walk.Dose);
  walk.Dose->SetAbortExecute(0);
  walk.Dose->Modified();
  walk.Dose->Update();
  EXPECT_TRUE(observer->Errors.empty());
  ASSERT_GT(BlocksOf(walk.Dose)->GetNumberOfBlocks(), 0u);
  EXPECT_TRUE(IsSame(OutputBits(BlocksOf(walk.Dose)), OutputBits(BlocksOf(alone.Dose))));
}

}

TEST(RanksOverTime, BringTheBitsOfOne)
{
  EXPECT_EQ(VisitsOfSameBits([](Walk&) {}), ShareOf(kTimes, Processes::Own()));
  VisitsOfSameBits([](Walk& walk) {
    walk.Dose->SetIntegrationModeToUniform();
    walk.Dose->SetNumberOfTimeSteps(6);
    walk.Dose->SetStartTime(0.1);
    walk.Dose->SetNumberOfSpreadPhotons(30);
    walk.Scene.Irradiance->SetComputeStandardError(true);
    walk.Scene.Irradiance->SetSeparateSides(true);
  });
}

namespace
{

/// All of the data, as VTK would send them.
std::string BytesOf(vtkDataObject* data)
{
  vtkNew<vtkCharArray> bytes;
  EXPECT_TRUE(vtkCommunicator::MarshalDataObject(data, bytes));
  return { bytes->GetPointer(0), static_cast<std::size_t>(bytes->GetNumberOfTuples()) };
}

/// A square on its way, with a pose, normals, components that have names, and a corner that never
/// moves.
vtkSmartPointer<PartOverTime> MakeRichSquare(bool hasWords)
{
  const auto square = MakeLitSquare(kTimes, [](double time) { return time / 3; });
  SetCellValues(square->Model, "Constant", { 1, 2 });
  square->Model->GetCellData()->GetArray("Constant")->SetComponentName(1, "second");
  if (hasWords)
  {
    vtkNew<vtkStringArray> words;
    words->SetName("Words");
    words->InsertNextValue("a word");
    square->Model->GetCellData()->AddArray(words);
  }
  SetCellValues(square->Model, "Normals", { 0, 0, 1 });
  square->Change = [light = square->Change](vtkPolyData* data, double time) {
    light(data, time);
    MoveTo(data, { time, 0, 0 });
    vtkDataArray* normals = data->GetCellData()->GetArray("Normals"); // the model's own
    normals->SetComponent(0, 0, time);
    normals->Modified();
    data->GetCellData()->SetActiveNormals("Normals");
    vtkNew<vtkIdList> corners;
    data->GetPolys()->GetCellAtId(0, corners);
    if ((corners->GetId(0) == 0) != (time < 0.3))
    {
      data->GetPolys()->ReverseCellAtId(0); // the model's, too
      data->GetPolys()->Modified();
    }
    vtkNew<vtkPoints> points;
    points->DeepCopy(data->GetPoints());
    points->SetPoint(2, 1, 1, time);
    data->SetPoints(points);
  };
  return square;
}

}

TEST(RanksOverTime, PassAllDataOn)
{
  for (const bool hasWords : { false, true })
  {
    for (const bool isGrid : { false, true })
    {
      const auto square = MakeRichSquare(hasWords);
      vtkNew<vtkAppendFilter> grid;
      grid->SetInputConnection(square->GetOutputPort());
      vtkAlgorithm* input = isGrid ? static_cast<vtkAlgorithm*>(grid) : square;
      const auto shared = MakeExposure(input), alone = MakeExposure(input);
      shared->SetController(Controller);
      shared->Update();
      alone->Update();
      EXPECT_GT(alone->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::CELL), 0);
      EXPECT_EQ(BytesOf(shared->GetOutputDataObject(0)), BytesOf(alone->GetOutputDataObject(0)));
    }
  }
}

// With more processes than times some have nothing to do.
TEST(RanksOverTime, MayBeMoreThanTimes)
{
  VisitsOfSameBits([](Walk& walk) {
    walk.Dose->SetIntegrationModeToUniform();
    walk.Dose->SetNumberOfTimeSteps(1);
  });
}

TEST(RanksOverTime, HalveIntervals)
{
  const auto set = [](Walk& walk) {
    walk.Dose->SetIntegrationModeToAutomatic(); // the first of the visits is between two steps
    walk.Dose->SetNumberOfTimeSteps(8);
    walk.Dose->SetRelativeTolerance(0.02);
    walk.Scene.Irradiance->SetComputeStandardError(true);
  };
  Walk one;
  set(one);
  one.Dose->Update();
  const std::size_t alone = one.Scene.Ball->Visits.size();
  EXPECT_GT(alone, 12u) << "it halves";
  const std::size_t shared = VisitsOfSameBits(set).size();
  EXPECT_LE(shared, Processes::Count() == 1 ? alone : alone * 2 / 3);
}

namespace
{

/// Some times are not to be had: then the input is that of another time, as with files.
void ExpectDoseOverSteps(const std::function<double(double)>& givenFor)
{
  std::vector<double> doses;
  for (vtkMultiProcessController* controller :
    { Controller, static_cast<vtkMPIController*>(nullptr) })
  {
    const auto square = MakeLitSquare(kTimes, [](double) { return 0; });
    square->Change = [&](vtkPolyData* polyData, double time) {
      SetCellValues(polyData, "Irradiance", { givenFor(time) });
      polyData->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), givenFor(time));
    };
    const auto dose = MakeExposure(square);
    dose->SetIntegrationModeToAutomatic();
    dose->SetNumberOfTimeSteps(6); // so it visits 0.75 as well
    dose->SetController(controller);
    dose->Update();
    doses.push_back(SquareExposure(dose));
    EXPECT_EQ(IntegrationTimesOf(dose), kTimes);
  }
  EXPECT_EQ(doses[0], doses[1]);
  EXPECT_DOUBLE_EQ(doses[0], 1.125); // t^2 / 2, by the trapezoidal rule
}

}

TEST(RanksOverTime, IntegrateOverTheStepsOfFiles)
{
  ExpectDoseOverSteps([](double time) {
    return *std::min_element(kTimes.begin(), kTimes.end(),
      [&](double a, double b) { return std::abs(a - time) < std::abs(b - time); });
  });
  // One process finds it out for all.
  ExpectDoseOverSteps([](double time) { return time == 0.75 ? 0.5 : time; });
}

// Whoever shares the walks otherwise computes alone for a dose whose times are shared.
TEST(RanksOverTime, DoNotShareWalksAsWell)
{
  const auto share = [](Walk& walk) { walk.Scene.Irradiance->SetController(Controller); };
  EXPECT_EQ(VisitsOfSameBits(share), ShareOf(kTimes, Processes::Own()));
  Walk walk;
  share(walk);
  walk.Dose->SetController(Controller);
  walk.Dose->Update();
  const OutputBits bits(BlocksOf(walk.Dose));
  walk.Dose->SetController(nullptr); // now the walks are shared
  walk.Scene.Ball->Visits.clear();
  walk.Dose->Update();
  EXPECT_TRUE(IsSame(OutputBits(BlocksOf(walk.Dose)), bits));
  EXPECT_EQ(walk.Scene.Ball->Visits, kTimes);
}

// What a dose asks of the light is over with it.
TEST(RanksOverTime, LeaveTheWalksShared)
{
  const auto expectShared = [](vtkIrradianceFilter* irradiance) {
    const auto observer = ErrorObserver::Watch(irradiance);
    irradiance->UpdateTimeStep(0.5);
    EXPECT_TRUE(observer->Errors.empty());
    const Walk alone;
    alone.Scene.Irradiance->UpdateTimeStep(0.5);
    EXPECT_TRUE(IsSame(OutputBits(irradiance), OutputBits(alone.Scene.Irradiance)));
    const double bytes = alone.Scene.Irradiance->GetFigure("HistoryBytes");
    EXPECT_EQ(irradiance->GetFigure("HistoryBytes") < bytes, Processes::Count() > 1);
  };
  Walk walk, failing;
  for (Walk* each : { &walk, &failing })
  {
    each->Scene.Irradiance->SetController(Controller);
    each->Dose->SetController(Controller);
  }
  walk.Dose->Update();
  expectShared(walk.Scene.Irradiance);
  failing.Scene.Ball->FailsAt = IsLast() ? kTimes[Processes::Own()] : 7;
  failing.Dose->Update();
  failing.Scene.Ball->FailsAt = 7;
  failing.Scene.Ball->Modified();
  expectShared(failing.Scene.Irradiance);
}

// Each process computes alone, so none may have a piece of the scene.
TEST(RanksOverTime, NeedTheWholeInput)
{
  Walk walk;
  walk.Scene.Irradiance->SetController(Controller);
  walk.Scene.Irradiance->SetDistributedInput(true);
  walk.Dose->SetController(Controller);
  const auto observer = ErrorObserver::Watch(walk.Scene.Irradiance);
  walk.Dose->Update();
  ASSERT_EQ(observer->Errors.size(), Processes::Count() > 1 ? 1u : 0u);
  if (Processes::Count() > 1)
  {
    ExpectWords(observer->Errors[0], { "DistributedInput is on", "share the times" });
  }
  walk.Scene.Irradiance->SetDistributedInput(false);
  ExpectWell(walk);
}

TEST(RanksOverTime, GiveAllToTheFirstPiece)
{
  Walk walk, alone;
  walk.Dose->SetController(Controller);
  walk.Dose->UpdatePiece(Processes::Own(), Processes::Count(), 0);
  alone.Dose->UpdatePiece(Processes::Own(), Processes::Count(), 0);
  const OutputBits bits(BlocksOf(walk.Dose));
  EXPECT_FALSE(bits.IsEmpty());
  EXPECT_EQ(BlocksOf(walk.Dose)->GetNumberOfCells() > 0, Processes::Own() == 0);
  if (Processes::Own() == 0)
  {
    EXPECT_TRUE(IsSame(bits, OutputBits(BlocksOf(alone.Dose))));
  }
}

TEST(RanksOverTime, HaveOneErrorEachWhenOneFailsUpstream)
{
  const std::vector<double> share = ShareOf(kTimes, Processes::Count() - 1);
  for (const double time : share)
  {
    Walk walk;
    walk.Dose->SetController(Controller);
    walk.Scene.Ball->FailsAt = IsLast() ? time : std::numeric_limits<double>::quiet_NaN();
    const auto ofBall = ErrorObserver::Watch(walk.Scene.Ball);
    const auto ofDose = ErrorObserver::Watch(walk.Dose);
    walk.Dose->Update();
    EXPECT_EQ(ofBall->Errors.size(), IsLast() ? 1u : 0u) << time;
    const bool isFirst = time == share.front(); // the pipeline asks for that one itself
    ASSERT_EQ(ofDose->Errors.size(), IsLast() && isFirst ? 0u : 1u) << time;
    if (!(IsLast() && isFirst))
    {
      ExpectWords(ofDose->Errors[0], { IsLast() ? "could not be computed at time" : Stopped });
    }
    walk.Scene.Ball->FailsAt = std::numeric_limits<double>::quiet_NaN();
    walk.Scene.Ball->Modified();
    ExpectWell(walk);
  }
}

TEST(RanksOverTime, HaveOneErrorEachWhenTheLightFails)
{
  Walk walk;
  walk.Dose->SetController(Controller);
  walk.Scene.Irradiance->SetDefaultDiffuseReflectance(IsLast() ? 2 : 0.5);
  const auto ofLight = ErrorObserver::Watch(walk.Scene.Irradiance);
  const auto ofDose = ErrorObserver::Watch(walk.Dose);
  walk.Dose->Update();
  EXPECT_EQ(ofLight->Errors.size(), IsLast() ? 1u : 0u);
  EXPECT_EQ(ofDose->Errors.size(), IsLast() ? 0u : 1u);
  walk.Scene.Irradiance->SetDefaultDiffuseReflectance(0.5);
  ExpectWell(walk);
}

TEST(RanksOverTime, HaveOneErrorEachWithOtherSettings)
{
  const std::vector<Settings> others{
    [](Walk& walk) { walk.Dose->SetEndTime(1); },
    [](Walk& walk) { walk.Dose->SetIntegrationModeToUniform(); },
    [](Walk& walk) { walk.Scene.Ball->Times[1] = 0.3; },
  };
  for (const Settings& other : others)
  {
    Walk walk;
    walk.Dose->SetController(Controller);
    if (Processes::Count() > 1)
    {
      if (IsLast())
      {
        other(walk);
      }
      ExpectWords(
        ErrorOf(walk.Dose), { "other settings or times than on the first process on 1 of " });
    }
  }
  Walk wrong;
  wrong.Dose->SetController(Controller);
  wrong.Dose->SetStartTime(IsLast() ? 7 : 0);
  ExpectError(wrong.Dose, "StartTime is 7", Stopped);
  wrong.Dose->SetStartTime(0);
  ExpectWell(wrong);
}

// All find what is wrong with the data, whoever has computed them.
TEST(RanksOverTime, HaveTheErrorOfOne)
{
  const auto square =
    MakeLitSquare(kTimes, [](double time) { return time == 0.25 ? std::nan("") : 1; });
  const auto dose = MakeExposure(square);
  dose->SetController(Controller);
  const auto observer = ErrorObserver::Watch(dose);
  dose->Update();
  ASSERT_EQ(observer->Errors.size(), 1u);
  ExpectWords(observer->Errors[0], { "the input, cell 0: Irradiance is nan at time 0.25" });
}

// The dose, or the light that it waits for.
TEST(RanksOverTime, StopAllWhenOneIsAborted)
{
  for (const bool isLight : { false, true })
  {
    Walk walk;
    walk.Dose->SetController(Controller);
    vtkAlgorithm* const stopped = isLight ? static_cast<vtkAlgorithm*>(walk.Scene.Irradiance)
                                          : static_cast<vtkAlgorithm*>(walk.Dose);
    EventObserver::Watch(stopped)->AbortIn = !IsLast() ? 0 : isLight ? 2 : 1;
    const auto observer = ErrorObserver::Watch(walk.Dose);
    walk.Dose->Update();
    EXPECT_EQ(observer->Errors.size(), IsLast() ? 0u : 1u);
    EXPECT_EQ(BlocksOf(walk.Dose)->GetNumberOfBlocks(), 0u);
    ExpectWell(walk);
  }
}

// An observer changes a setting: on all, and they begin again; on some, and each has one error.
TEST(RanksOverTime, AgreeOnWhatChangesMeanwhile)
{
  for (const bool isOnAll : { true, false })
  {
    Walk walk, alone;
    walk.Dose->SetController(Controller);
    alone.Dose->SetStartTime(0.5);
    alone.Dose->Update();
    if (isOnAll || IsLast())
    {
      EventObserver::Watch(walk.Dose)->Change = [&] { walk.Dose->SetStartTime(0.5); };
    }
    const auto observer = ErrorObserver::Watch(walk.Dose);
    walk.Dose->Update();
    if (isOnAll || Processes::Count() == 1)
    {
      EXPECT_TRUE(observer->Errors.empty());
      EXPECT_TRUE(IsSame(OutputBits(BlocksOf(walk.Dose)), OutputBits(BlocksOf(alone.Dose))));
    }
    else
    {
      ASSERT_EQ(observer->Errors.size(), 1u);
      ExpectWords(observer->Errors[0], { "something was changed meanwhile" });
    }
  }
}
