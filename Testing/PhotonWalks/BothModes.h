// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_test_BothModes_h
#define irradiance_test_BothModes_h

#include "EngineRun.h"

#include <gtest/gtest.h>

namespace irradiance::test
{

/// Tests that hold however direct light is known: shot, or gathered.
class BothModes : public testing::TestWithParam<bool>
{
protected:
  static bool isGathered() { return GetParam(); }

  static EngineSettings settingsFor(std::uint64_t seed, std::uint32_t walks)
  {
    EngineSettings settings;
    settings.numberOfWalks = walks;
    settings.seed = seed;
    settings.gathersDirectLight = isGathered();
    return settings;
  }

  /// Calls use(engine) with a first frame of each seed from 1 on.
  template <class Use>
  static void overSeeds(const SceneObjects& objects, int seeds, std::uint32_t walks, const Use& use)
  {
    for (int seed = 1; seed <= seeds; ++seed)
    {
      EngineSettings settings = settingsFor(static_cast<std::uint64_t>(seed), walks);
      settings.verify = false;
      IrradianceEngine engine;
      Execution serial;
      engine.update(objects, settings, serial);
      Power rest = engine.balance().emitted;
      rest -= engine.balance().absorbed;
      rest -= engine.balance().escaped;
      ASSERT_TRUE(rest.isZero()) << "seed " << seed;
      use(engine);
    }
  }
};

inline std::string nameOfMode(const testing::TestParamInfo<bool>& info)
{
  return info.param ? "Gathered" : "Shot";
}

}

#endif
