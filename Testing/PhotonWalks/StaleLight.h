// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_test_StaleLight_h
#define irradiance_test_StaleLight_h

#include "IrradianceEngine.h"

#include <gtest/gtest.h>

/// What an engine says of its stale walks.
namespace irradiance::test
{

constexpr double kNoTime = 1e-9; ///< s; a budget that is over when it begins

/// Walks.
inline std::size_t numberOfStale(const IrradianceEngine& engine)
{
  std::size_t count = 0;
  for (const WalkSet& set : engine.walks().sets())
  {
    count += set.stale() ? set.stale()->numberOfUnborn() : 0;
    for (std::size_t block = 0; set.stale() && block < set.stale()->numberOfBlocks(); ++block)
    {
      count += set.stale()->marks(block).size();
    }
  }
  return count;
}

inline void expectBalance(const IrradianceEngine& engine)
{
  Power sum = engine.balance().absorbed;
  sum += engine.balance().escaped;
  EXPECT_EQ(sum.quanta, engine.balance().emitted.quanta);
}

}

#endif
