// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_StoredSensors_h
#define irradiance_StoredSensors_h

#include "Views/SensorFinalGather.h"

#include <atomic>
#include <memory>
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
    const std::vector<Sensor>& sensors, std::uint32_t rays, bool keepsRays, Execution& execution);

  /// Of all sensors.
  std::vector<SensorFinalGather::Light> lights() const;
  const std::vector<SensorFinalGather::Replicates>& replicates() const { return replicates_; }
  /// Paths and rays to lights that the last update cast.
  std::int64_t numberCast() const { return cast_; }
  /// Of the rays that are kept.
  std::size_t bytes() const;

private:
  /// `isDone`: by sensor, whether its light is that of this frame.
  void gather(const IrradianceEngine& engine, const std::vector<bool>& isDone, std::uint32_t rays,
    bool keepsRays, Execution& execution);

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

#endif
