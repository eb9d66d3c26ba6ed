#include "Measuring/EngineTiming.h"

#include <stdexcept>
#include <string>

using namespace irradiance;

UpdateTime timeUpdate(IrradianceEngine& engine, const SceneObjects& objects,
  const EngineSettings& settings, Execution& execution)
{
  const double start = execution.seconds();
  engine.update(objects, settings, execution);
  const double whole = execution.seconds() - start;
  // The engine's own clocks run on while the machine does other things; only their ratios are used.
  const EngineStatistics& cost = engine.statistics();
  const double perSecond = whole / (cost.shootSeconds + cost.verifySeconds + cost.repairSeconds);
  return { whole, cost.verifySeconds * perSecond, cost.repairSeconds * perSecond };
}

UpdateTime timeUpdate(
  IrradianceEngine& engine, const SceneObjects& objects, const EngineSettings& settings)
{
  CpuTime execution;
  return timeUpdate(engine, objects, settings, execution);
}

void requireEqualSums(
  const IrradianceEngine& a, const IrradianceEngine& b, const SceneObjects& objects)
{
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    for (std::size_t cell = 0; cell < objects[object].surface->numberOfCells; ++cell)
    {
      if (a.sums().sum(object, cell, 0, 0) != b.sums().sum(object, cell, 0, 0))
      {
        throw std::runtime_error("The answers differ on object " + std::to_string(object) +
          ", cell " + std::to_string(cell));
      }
    }
  }
}
