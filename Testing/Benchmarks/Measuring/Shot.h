// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Measuring/CellField.h"
#include "Measuring/EngineTiming.h"
#include "Rivals/PlainTracer.h"

/// What was shot, and the CPU time of the one thread that it took.
struct Shot
{
  double nsPerSegment() const { return 1e9 * seconds / static_cast<double>(segments); }

  double seconds;
  std::int64_t segments;
  CellField irradiance;
};

/// By an engine that is new, or that is to shoot again.
inline Shot shoot(irradiance::IrradianceEngine& engine, const irradiance::SceneObjects& objects,
  const irradiance::EngineSettings& settings)
{
  const double seconds = timeUpdate(engine, objects, settings).whole;
  return { seconds, engine.balance().segments, irradianceOf(engine, objects) };
}

/// `scene`: from the objects, as is the tracer.
inline Shot shoot(const PlainTracer& tracer, const irradiance::SceneObjects& objects,
  const PlainScene& scene, const irradiance::EngineSettings& settings)
{
  const double start = threadCpuSeconds();
  const PlainTracer::Tally tally = tracer.shoot(settings.numberOfWalks, settings.seed);
  const double seconds = threadCpuSeconds() - start;
  const double photon = scene.totalFlux() / settings.numberOfWalks;
  const double* hits = tally.hits.data();
  return { seconds, tally.segments, fieldOf(objects, [&](std::uint32_t, std::size_t, double area) {
            const double watts = photon * *hits++;
            return area > 0 ? watts / area : 0.0;
          }) };
}

inline irradiance::EngineSettings withSeed(irradiance::EngineSettings settings, std::uint64_t seed)
{
  settings.seed = seed;
  return settings;
}

inline Shot shootNew(
  const irradiance::SceneObjects& objects, const irradiance::EngineSettings& settings)
{
  irradiance::IrradianceEngine engine;
  return shoot(engine, objects, settings);
}

/// The mean of what was added.
class Mean
{
public:
  void add(double value)
  {
    sum_ += value;
    ++count_;
  }
  double value() const { return sum_ / count_; }

private:
  double sum_ = 0;
  int count_ = 0;
};
