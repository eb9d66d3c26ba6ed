// SPDX-License-Identifier: BSD-3-Clause
// The random programs of TestRandomPrograms.cxx with a filter whose walks all processes share. Each
// process does the same at the same time, and compares it and what follows it with filters alone.
// Hence nothing may depend on what one process alone knows.

#include "ExposureScenes.h"
#include "Processes.h"
#include "RandomProgram.h"

#include <gtest/gtest.h>

#include <cstring>
#include <iterator>

using namespace RandomPrograms;

namespace
{

/// One process stops. Either the others then have an error, or it comes too late on all.
void AbortOnOne(Trial& t)
{
  MoveAPose(t);
  t.Filter->Modified();
  t.Reports->Clear();
  const bool isOwn = t.Random.Below(Processes::Count()) == Processes::Own();
  t.UpdateAndMeddle([&] { isOwn ? t.Filter->SetAbortExecute(1) : void(); });
  const bool isEmpty = t.Filter->GetOutput()->GetNumberOfBlocks() == 0;
  const std::vector<std::string>& errors = t.Reports->Errors;
  const int empty = Processes::Sum(isEmpty);
  EXPECT_TRUE(empty == 0 || empty == Processes::Count()) << empty << " are empty";
  EXPECT_LE(errors.size(), 1u);
  const int stopped = Processes::Sum(isEmpty && errors.empty());
  EXPECT_LE(stopped, 1);
  EXPECT_TRUE(
    stopped > 0 || errors.empty() || errors[0].find("failed or was stopped") == std::string::npos)
    << errors[0];
  t.Done.Aborts += stopped;
  t.Filter->SetAbortExecute(0);
  t.Filter->Modified();
  t.MustCompare = true;
}

/// The dose of some time. What a budget leaves stale has none.
void AddUpADose(Trial& t)
{
  if (t.Set().RepairTimeBudget > 0)
  {
    return;
  }
  const auto dose = [](vtkIrradianceFilter* filter) {
    const auto exposure = ExposureScenes::MakeExposure(filter);
    exposure->SetIntegrationModeToUniform();
    exposure->SetStartTime(0);
    exposure->SetEndTime(0.25); // no ride ends before
    exposure->SetNumberOfTimeSteps(2);
    exposure->Update();
    return OutputBits(ExposureScenes::BlocksOf(exposure));
  };
  const OutputBits bits = dose(t.Filter);
  EXPECT_TRUE(!bits.IsEmpty() || t.HasSky()); // out of its bounds there is no dose
  EXPECT_TRUE(IsSame(bits, dose(t.MakeFresh())));
}

/// MeddleWhileItRuns changes the scene at another time on each process. If one reads it before the
/// change and one after it, that update fails on all, but not the next one.
std::vector<Operation> SharedOperations()
{
  std::vector<Operation> operations(std::begin(Operations), std::end(Operations));
  for (Operation& operation : operations)
  {
    if (std::strcmp(operation.Name, "Abort") == 0)
    {
      operation = { "AbortOnOne", AbortOnOne, 3 };
    }
  }
  operations.push_back({ "AddUpADose", AddUpADose, 3 });
  return operations;
}

}

TEST(RandomRanks, UpdatesEqualFreshFiltersAlone)
{
  const std::vector<Operation> operations = SharedOperations();
  Counts counts;
  ForEachProgram(16, [&](int program, bool isAloud) {
    Trial trial(static_cast<std::uint64_t>(program), counts, Processes::Controller);
    trial.Set().NumberOfWalks += 1000; // two blocks or three, to be shared
    trial.Set().NumberOfOutputWalks = program % 4 == 0 ? ShownWalks::All : 0;
    trial.Apply();
    if (program % 2 == 0) // a look excludes budgets
    {
      trial.Given.Look.HasEye = trial.Given.Look.HasSensors = trial.Given.Look.HasPoints = false;
    }
    RunProgram(program, trial, operations, isAloud && Processes::Own() == 0);
  });
  if (Processes::Own() == 0)
  {
    Print(counts);
  }
  // All have done the same.
  auto digest = static_cast<vtkTypeInt64>(counts.Digest);
  Processes::Controller->Broadcast(&digest, 1, 0);
  EXPECT_EQ(static_cast<std::uint64_t>(digest), counts.Digest);
}
