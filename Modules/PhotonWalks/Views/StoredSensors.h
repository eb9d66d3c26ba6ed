// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Views/SensorFinalGather.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace irradiance
{

/**
 * What sensors gather, see SensorFinalGather, from update to update. Where things have moved only
 * rays are cast anew that this may change, and what all bring is read anew from the present sums;
 * sensors that moved gather anew. Where nothing else may be kept, all do. The results are those of
 * SensorFinalGather, bit for bit.
 */
class StoredSensors
{
public:
  /// To the present frame of an engine. `rays`: see SensorFinalGather. `keepsRays`: for frames in
  /// which things have moved; only kept if something may move, and the engine verifies. Throws what
  /// SensorFinalGather throws; after that nothing is kept.
  void update(const std::shared_ptr<const IrradianceEngine>& engine,
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

  /// Of all sensors.
  std::vector<SensorFinalGather::Light> lights() const
  {
    std::vector<SensorFinalGather::Light> lights(replicates_.size());
    std::transform(
      replicates_.begin(), replicates_.end(), lights.begin(), SensorFinalGather::lightOf);
    return lights;
  }
  const std::vector<SensorFinalGather::Replicates>& replicates() const { return replicates_; }
  /// Paths and rays to lights that the last update cast.
  std::int64_t numberCast() const { return cast_; }
  /// Of the rays that are kept.
  std::size_t bytes() const
  {
    return std::accumulate(units_.begin(), units_.end(), std::size_t{ 0 },
      [](std::size_t sum, const SensorFinalGather::Rays& rays) { return sum + rays.bytes(); });
  }

private:
  /// `isDone`: by sensor, whether its light is that of this frame.
  void gather(const IrradianceEngine& engine, const std::vector<bool>& isDone, std::uint32_t rays,
    bool keepsRays, Execution& execution)
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
      const auto at = [&](
                        std::size_t i) { return isDone.begin() + static_cast<std::ptrdiff_t>(i); };
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

  std::weak_ptr<const IrradianceEngine> engine_; ///< for which all below was found
  std::uint64_t state_ = 0;
  std::uint32_t rays_ = 0;
  std::vector<Sensor> sensors_;
  std::vector<SensorFinalGather::Replicates> replicates_;
  std::optional<PathsOrigin> origin_;          ///< of the rays that are kept
  std::vector<SensorFinalGather::Rays> units_; ///< of sensors whose rays are cast together
  std::atomic<std::int64_t> cast_{ 0 };
};

}
