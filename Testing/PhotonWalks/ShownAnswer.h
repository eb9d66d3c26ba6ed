// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_test_ShownAnswer_h
#define irradiance_test_ShownAnswer_h

#include "EngineRun.h"

#include <cstring>

namespace irradiance::test
{

/// The engine's whole answer, and the bits of all that it says of cells: irradiance, stale
/// irradiance and standard errors.
inline Answer shownAnswer(
  const IrradianceEngine& engine, const SceneObjects& objects, const EngineSettings& settings)
{
  Answer answer = answerOf(engine, objects, settings.separateSides);
  const auto add = [&](double value) {
    std::int64_t bits;
    std::memcpy(&bits, &value, sizeof(bits));
    answer.push_back(bits);
  };
  const ErrorEstimate errors = engine.errorEstimate();
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    for (std::size_t cell = 0; cell < engine.cells().numbers().sizeOf(object); ++cell)
    {
      for (int side = 0; side < (settings.separateSides ? 2 : 1); ++side)
      {
        for (int band = 0; band < objects.staticObject.material->bands; ++band)
        {
          add(engine.irradiance({ object, cell, side }, band));
          add(engine.staleIrradiance({ object, cell, side }, band));
          add(errors.standardError({ object, cell, side }, band));
        }
      }
    }
  }
  add(engine.reachedRelativeError());
  add(engine.watts(engine.balance().emitted[0]));
  answer.push_back(engine.numberOfWalks());
  return answer;
}

/// The answer of a new engine.
inline Answer freshShownAnswer(const SceneObjects& objects, const EngineSettings& settings)
{
  IrradianceEngine engine;
  Execution serial;
  engine.update(objects, settings, serial);
  return shownAnswer(engine, objects, settings);
}

}

#endif
