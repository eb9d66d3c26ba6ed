#ifndef EngineTiming_h
#define EngineTiming_h

#include "IrradianceEngine.h"
#include "Measuring/Rounds.h"

#include <atomic>
#include <thread>

/// One thread by its CPU time: other programs do not disturb it.
class CpuTime : public irradiance::Execution
{
public:
  double seconds() const override { return threadCpuSeconds(); }
};

/// Two threads of the standard library by the clock on the wall. Each takes the next item when it has
/// done one.
class TwoThreads : public irradiance::Execution
{
public:
  void parallelFor(
    std::size_t count, const std::function<void(std::size_t, std::size_t)>& task) override
  {
    std::atomic<std::size_t> next{ 0 };
    const auto work = [&] {
      for (std::size_t i = next++; i < count; i = next++)
      {
        task(i, i + 1);
      }
    };
    std::thread second(work);
    work();
    second.join();
  }
};

/// Seconds of an update by the clock of its execution.
struct UpdateTime
{
  double whole, verification, repair;
};

UpdateTime timeUpdate(irradiance::IrradianceEngine& engine, const irradiance::SceneObjects& objects,
  const irradiance::EngineSettings& settings, irradiance::Execution& execution);
/// On one thread, CPU time.
UpdateTime timeUpdate(irradiance::IrradianceEngine& engine, const irradiance::SceneObjects& objects,
  const irradiance::EngineSettings& settings);

/// Throws std::runtime_error when a cell of the scene has received other power in one than in the other.
void requireEqualSums(const irradiance::IrradianceEngine& a, const irradiance::IrradianceEngine& b,
  const irradiance::SceneObjects& objects);

#endif
