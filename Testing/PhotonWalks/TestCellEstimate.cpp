// SPDX-License-Identifier: BSD-3-Clause
#include "Estimates/CellEstimate.h"
#include "Walks/WalkSettings.h"

#include <gtest/gtest.h>

#include <utility>

namespace irradiance
{

// What is known of the error is known of sums, also spread ones.
TEST(CellEstimate, NearestExcludesWhatIsKnownOfSumsAlone)
{
  WalkSettings bars, target, budget;
  bars.replicates = 16;
  target.replicates = 16;
  target.targetRelativeError = 0.05;
  budget.repairTimeBudget = 0.1;
  const std::pair<WalkSettings, const char*> others[] = { { bars, "ComputeStandardError" },
    { target, "TargetRelativeError" }, { budget, "RepairTimeBudget" } };
  for (const auto& [walks, name] : others)
  {
    EXPECT_EQ(conflictOf({ CellEstimate::Sums }, walks), "");
    EXPECT_EQ(conflictOf({ CellEstimate::Spread }, walks), "");
    EXPECT_EQ(conflictOf({ CellEstimate::Nearest }, walks)
                .find("CellEstimate Nearest and " + std::string(name) + " exclude each other"),
      0u);
  }
  EXPECT_EQ(conflictOf({ CellEstimate::Nearest }, {}), "");
}

}
