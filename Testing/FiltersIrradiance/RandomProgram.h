// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RandomOperations.h"

#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

/// Random sequences of operations.
namespace RandomPrograms
{

constexpr int OperationsOfAProgram = 25;

inline const Operation& PickOperation(
  RandomNumbers& random, const std::vector<Operation>& operations)
{
  int weights = 0;
  for (const Operation& operation : operations)
  {
    weights += operation.Weight;
  }
  int left = random.Below(weights);
  std::size_t i = 0;
  while (left >= operations[i].Weight)
  {
    left -= operations[i++].Weight;
  }
  return operations[i];
}

inline void RunProgram(
  int program, Trial& trial, const std::vector<Operation>& operations, bool isAloud)
{
  std::string done;
  const auto step = [&](const char* name, void (*change)(Trial&)) {
    done += std::string(done.empty() ? "" : ", ") + name;
    SCOPED_TRACE("VTKIRRADIANCE_TEST_PROGRAM=" + std::to_string(program) + ": " + done);
    isAloud ? static_cast<void>(std::cout << name << std::endl) : void();
    change(trial);
    trial.UpdateAndCheck();
  };
  step("Start", [](Trial&) {});
  for (int i = 0; i < OperationsOfAProgram && !testing::Test::HasFailure(); ++i)
  {
    const Operation& operation = PickOperation(trial.Random, operations);
    step(operation.Name, operation.Do);
  }
  if (!testing::Test::HasFailure())
  {
    step("End", [](Trial& t) {
      t.Set().RepairTimeBudget = 0;
      t.Apply();
      t.MustCompare = true;
    });
  }
}

inline int NumberFrom(const char* variable, int otherwise)
{
  const char* text = std::getenv(variable);
  return text ? std::atoi(text) : otherwise;
}

/// Calls run(program, isAloud) for each program that the environment asks for, until a test fails.
template <class Run>
void ForEachProgram(int most, const Run& run)
{
  const int alone = NumberFrom("VTKIRRADIANCE_TEST_PROGRAM", -1);
  const int count = most * std::max(1, NumberFrom("VTKIRRADIANCE_TEST_EFFORT", 1));
  for (int i = alone < 0 ? 0 : alone;
       i < (alone < 0 ? count : alone + 1) && !testing::Test::HasFailure(); ++i)
  {
    run(i, alone >= 0);
  }
}

inline void Print(const Counts& counts)
{
  std::cout << counts.Operations << " operations, " << counts.Repairs << " repairs, "
            << counts.Compared << " comparisons, " << counts.Stale << " of them stale, "
            << counts.Luminaires << " lamps with a table and " << counts.Skies << " skies in them, "
            << counts.Errors << " errors, " << counts.Mishaps << " by chance, " << counts.Aborts
            << " aborts, " << counts.Meddlings << " changes while it ran, " << counts.Looks
            << " looks at its photons, " << counts.Shown << " comparisons of walks, "
            << counts.Gathered << " of gathered light, " << counts.FinalGathers
            << " of the final gather, " << counts.ChosenGathers
            << " of these chosen; digest of the answers " << std::hex << counts.Digest << std::dec
            << '\n';
}

}
