// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_test_ShownAnswer_h
#define irradiance_test_ShownAnswer_h

#include "EngineRun.h"

namespace irradiance::test
{

/// The engine's whole answer, and the bits of all that it says of cells: irradiance, stale
/// irradiance and standard errors.
inline Answer shownAnswer(
  const IrradianceEngine& engine, const SceneObjects& objects, const EngineSettings& settings)
{
  Answer answer = answerOf(engine, objects, settings.separateSides);
  const ErrorEstimate errors = engine.errorEstimate();
  forEachSide(objects, settings.separateSides, [&](const CellSide& side, int band) {
    addBits(answer, engine.irradiance(side, band));
    addBits(answer, engine.staleIrradiance(side, band));
    addBits(answer, errors.standardError(side, band));
  });
  addBits(answer, engine.reachedRelativeError());
  answer.push_back(engine.numberOfWalks());
  return answer;
}

/// The answer of a new engine.
inline Answer freshShownAnswer(const SceneObjects& objects, const EngineSettings& settings)
{
  return shownAnswer(UpdatedEngine(objects, settings), objects, settings);
}

}

#endif
