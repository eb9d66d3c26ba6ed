// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../../PhotonWalks/EngineRun.h"
#include "Measuring/Rounds.h"

#include <stdexcept>

/// One thread by its CPU time: other programs do not disturb it.
class CpuTime : public irradiance::Execution
{
public:
  double seconds() const override { return threadCpuSeconds(); }
};

/// Seconds of an update by the clock of its execution.
struct UpdateTime
{
  double whole, verification, repair;
};

inline UpdateTime timeUpdate(irradiance::IrradianceEngine& engine,
  const irradiance::SceneObjects& objects, const irradiance::EngineSettings& settings,
  irradiance::Execution& execution)
{
  const double start = execution.seconds();
  engine.update(objects, settings, execution);
  const double whole = execution.seconds() - start;
  // The engine's own clocks run on while the machine does other work; only their ratios are used.
  const irradiance::EngineStatistics& cost = engine.statistics();
  const double perSecond = whole / (cost.shootSeconds + cost.verifySeconds + cost.repairSeconds);
  return { whole, cost.verifySeconds * perSecond, cost.repairSeconds * perSecond };
}

/// On one thread, CPU time.
inline UpdateTime timeUpdate(irradiance::IrradianceEngine& engine,
  const irradiance::SceneObjects& objects, const irradiance::EngineSettings& settings)
{
  CpuTime execution;
  return timeUpdate(engine, objects, settings, execution);
}

/// Throws std::runtime_error unless both engines have the same answer for the scene, to the bit.
inline void requireEqualAnswers(const irradiance::IrradianceEngine& a,
  const irradiance::IrradianceEngine& b, const irradiance::SceneObjects& objects)
{
  if (irradiance::test::answerOf(a, objects) != irradiance::test::answerOf(b, objects))
  {
    throw std::runtime_error("The answers differ");
  }
}
