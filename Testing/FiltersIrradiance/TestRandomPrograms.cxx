// SPDX-License-Identifier: BSD-3-Clause
// Random programs of what users do to one long-lived filter, which keeps the bits of a fresh one
// (compared after a third of the operations), and so do an eye and sensors that look at its photons. VTKIRRADIANCE_TEST_EFFORT=9 runs nine times as many,
// VTKIRRADIANCE_TEST_PROGRAM=17 runs number 17 alone and prints each operation. Two builds that compute the same
// bits print the same digest.

#include "RandomOperations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

using namespace RandomPrograms;

namespace
{

constexpr int NumberOfPrograms = 40;
constexpr int OperationsOfAProgram = 25;

const Operation& PickOperation(RandomNumbers& random)
{
  static const std::vector<const Operation*> weighted = [] {
    std::vector<const Operation*> all;
    for (const Operation& operation : Operations)
    {
      all.insert(all.end(), static_cast<std::size_t>(operation.Weight), &operation);
    }
    return all;
  }();
  return *weighted[static_cast<std::size_t>(random.Below(static_cast<int>(weighted.size())))];
}

void RunProgram(int program, bool isAloud, Counts& counts)
{
  std::string done;
  Trial trial(static_cast<std::uint64_t>(program), counts);
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
    const Operation& operation = PickOperation(trial.Random);
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

int NumberFrom(const char* variable, int otherwise)
{
  const char* text = std::getenv(variable);
  return text ? std::atoi(text) : otherwise;
}

}

TEST(RandomPrograms, UpdatesEqualFreshFilters)
{
  const int alone = NumberFrom("VTKIRRADIANCE_TEST_PROGRAM", -1);
  const int count = NumberOfPrograms * std::max(1, NumberFrom("VTKIRRADIANCE_TEST_EFFORT", 1));
  Counts counts;
  for (int i = alone < 0 ? 0 : alone; i < (alone < 0 ? count : alone + 1) && !HasFailure(); ++i)
  {
    RunProgram(i, alone >= 0, counts);
  }
  std::cout << counts.Operations << " operations, " << counts.Repairs << " repairs, "
            << counts.Compared << " comparisons, " << counts.Stale << " of them stale, "
            << counts.Errors << " errors, " << counts.Aborts << " aborts, " << counts.Meddlings
            << " changes while it ran, " << counts.Looks << " looks at its photons, "
            << counts.Shown << " comparisons of walks; digest of the answers " << std::hex
            << counts.Digest << std::dec << '\n';
}
