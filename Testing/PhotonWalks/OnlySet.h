// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_test_OnlySet_h
#define irradiance_test_OnlySet_h

#include "IrradianceEngine.h"

#include <cassert>

namespace irradiance::test
{

/// The set of walks of an engine with one group of lights.
inline const WalkSet& onlySet(const IrradianceEngine& engine)
{
  assert(engine.walks().sets().size() == 1);
  return engine.walks().sets().front();
}

}

#endif
