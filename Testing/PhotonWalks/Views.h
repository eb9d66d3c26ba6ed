// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_test_Views_h
#define irradiance_test_Views_h

#include "EngineRun.h"
#include "Views/OutgoingRadiance.h"
#include "Views/SensorFinalGather.h"

#include "../RayCasting/RandomVectors.h"

#include <cstring>
#include <numeric>
#include <vector>

namespace irradiance::test
{

/// What sensors and eyes find in the present frame of an engine, or of a new one.

/// Bit for bit.
template <class Light>
bool areSame(const std::vector<Light>& a, const std::vector<Light>& b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

/// Of a sensor, where another number would do.
constexpr std::uint32_t kRays = 64;

inline std::vector<SensorFinalGather::Light> gathered(
  const IrradianceEngine& engine, const std::vector<Sensor>& sensors, std::uint32_t rays = kRays)
{
  Execution serial;
  std::vector<std::size_t> numbers(sensors.size());
  std::iota(numbers.begin(), numbers.end(), std::size_t{ 0 });
  return SensorFinalGather(engine, rays, serial).at(sensors, numbers);
}

inline std::vector<SensorFinalGather::Light> gathered(const SceneObjects& objects,
  const EngineSettings& settings, const std::vector<Sensor>& sensors, std::uint32_t rays = kRays)
{
  return gathered(UpdatedEngine(objects, settings), sensors, rays);
}

/// In and around a room of 4 m; a third of them receive from all directions.
inline std::vector<Sensor> randomSensors(int count)
{
  RandomVectors random(5);
  std::vector<Sensor> sensors;
  for (int i = 0; i < count; ++i)
  {
    sensors.push_back({ Vector3(2, 2, 2) + 2.2 * random.inCube(),
      i % 3 == 0 ? Vector3(0, 0, 0) : Vector3(random.inCube().normalized()) });
  }
  return sensors;
}

using SeenLights = std::vector<OutgoingRadiance::Light>;

inline SeenLights seen(const IrradianceEngine& engine, const std::vector<SceneCell>& cells,
  const Eye& eye, std::uint32_t samples = 16)
{
  Execution serial;
  return OutgoingRadiance(engine, samples, serial).at(cells, eye);
}

inline SeenLights seen(const SceneObjects& objects, const EngineSettings& settings,
  const std::vector<SceneCell>& cells, const Eye& eye, std::uint32_t samples = 16)
{
  return seen(UpdatedEngine(objects, settings), cells, eye, samples);
}

inline std::vector<SceneCell> cellsOf(const SceneObjects& objects)
{
  std::vector<SceneCell> cells;
  CellNumbers(objects).forEach([&](const SceneCell& cell) { cells.push_back(cell); });
  return cells;
}

}

#endif
