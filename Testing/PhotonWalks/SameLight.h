// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_test_SameLight_h
#define irradiance_test_SameLight_h

#include "Views/SensorFinalGather.h"

#include <cstring>
#include <numeric>
#include <vector>

namespace irradiance::test
{

/// Bit for bit.
inline bool areSame(
  const std::vector<SensorFinalGather::Light>& a, const std::vector<SensorFinalGather::Light>& b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

/// Of a sensor, where another number would do.
constexpr std::uint32_t kRays = 64;

/// What sensors gather of the present frame of an engine.
inline std::vector<SensorFinalGather::Light> gathered(
  const IrradianceEngine& engine, const std::vector<Sensor>& sensors, std::uint32_t rays = kRays)
{
  Execution serial;
  std::vector<std::size_t> numbers(sensors.size());
  std::iota(numbers.begin(), numbers.end(), std::size_t{ 0 });
  return SensorFinalGather(engine, rays, serial).at(sensors, numbers);
}

/// By a new engine.
inline std::vector<SensorFinalGather::Light> gathered(const SceneObjects& objects,
  const EngineSettings& settings, const std::vector<Sensor>& sensors, std::uint32_t rays = kRays)
{
  IrradianceEngine engine;
  Execution serial;
  engine.update(objects, settings, serial);
  return gathered(engine, sensors, rays);
}

}

#endif
