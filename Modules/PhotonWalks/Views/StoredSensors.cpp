// SPDX-License-Identifier: BSD-3-Clause
#include "Views/StoredSensors.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace irradiance
{

void StoredSensors::update(const std::shared_ptr<const IrradianceEngine>& engine,
  const std::vector<Sensor>& sensors, std::uint32_t rays, bool keepsRays, Execution& execution)
{
  const bool isSameFrame = engine_.lock() == engine && state_ == engine->state() && rays_ == rays;
  engine_.reset(); // until the end is reached
  std::vector<bool> isDone(sensors.size());
  for (std::size_t i = 0; isSameFrame && i < sensors.size(); ++i)
  {
    isDone[i] = i < sensors_.size() && sensors[i] == sensors_[i];
  }
  sensors_ = sensors;
  replicates_.resize(sensors.size());
  cast_ = 0;
  if (!keepsRays)
  {
    units_.clear();
    origin_.reset();
  }
  if (std::find(isDone.begin(), isDone.end(), false) != isDone.end())
  {
    const bool mayMove = engine->settings().verify && !engine->objects().dynamicObjects.empty();
    gather(*engine, isDone, rays, keepsRays && mayMove, execution);
  }
  engine_ = engine;
  state_ = engine->state();
  rays_ = rays;
}

void StoredSensors::gather(const IrradianceEngine& engine, const std::vector<bool>& isDone,
  std::uint32_t rays, bool keepsRays, Execution& execution)
{
  constexpr double kPrepared = 0.25; // of the progress, roughly, if sides are to be counted
  ProgressSpan preparing(execution, 0, kPrepared), gathering(execution, kPrepared, 1);
  const SensorFinalGather gather(engine, rays, preparing, keepsRays);
  PathsOrigin origin(gather.scene());
  const std::optional<PathsOrigin> before = std::exchange(origin_, std::nullopt);
  const std::optional<FinalGatherMotion> motion =
    before ? FinalGatherMotion::since(*before, gather.scene(), origin) : std::nullopt;
  const std::size_t together = startsTogether(gather.scene());
  const std::size_t units = (sensors_.size() + together - 1) / together;
  if (!motion)
  {
    units_.clear();
  }
  units_.resize(keepsRays ? units : 0);
  forEachSliced(units, gathering, [&](std::size_t unit) {
    const std::size_t first = unit * together, end = std::min(first + together, sensors_.size());
    const auto at = [&](std::size_t i) { return isDone.begin() + static_cast<std::ptrdiff_t>(i); };
    // If rays are kept, all or none: those that are done find what they found before.
    const bool takesAll = keepsRays && std::find(at(first), at(end), false) != at(end);
    std::vector<std::size_t> numbers;
    for (std::size_t i = first; i < end; ++i)
    {
      if (takesAll || !isDone[i])
      {
        numbers.push_back(i);
      }
    }
    if (numbers.empty())
    {
      return;
    }
    SensorFinalGather::Rays none;
    std::int64_t cast = 0;
    std::vector<SensorFinalGather::Replicates> found = gather.update(
      sensors_, numbers, motion ? &*motion : nullptr, keepsRays ? units_[unit] : none, cast);
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
      replicates_[numbers[i]] = std::move(found[i]);
    }
    cast_ += cast;
  });
  if (keepsRays)
  {
    origin_ = std::move(origin);
  }
}

std::vector<SensorFinalGather::Light> StoredSensors::lights() const
{
  std::vector<SensorFinalGather::Light> lights(replicates_.size());
  std::transform(
    replicates_.begin(), replicates_.end(), lights.begin(), SensorFinalGather::lightOf);
  return lights;
}

std::size_t StoredSensors::bytes() const
{
  return std::accumulate(units_.begin(), units_.end(), std::size_t{ 0 },
    [](std::size_t sum, const SensorFinalGather::Rays& rays) { return sum + rays.bytes(); });
}

}
