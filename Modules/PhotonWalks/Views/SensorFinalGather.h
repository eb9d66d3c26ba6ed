// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "FinalGather/FinalGatherMotion.h"
#include "Photons/Sensor.h"
#include "Views/ViewFinalGather.h"

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace irradiance
{

/// Of all that is no lamp, or of everything if there are only lamps: a far lamp does not make what
/// is near less exact.
Box boundsBesideLamps(const SceneObjects& objects);

/// How far sensors are taken off the places that they are given, m: 2^-20 of the size of the scene,
/// for what users round, and two steps of rays off their surfaces, for places far from the origin.
/// `near`: boundsBesideLamps().
double sensorClearance(const Box& near);

/**
 * Where a sensor receives its light. Sensors stand on surfaces, but their coordinates are rounded:
 * so each is taken off the place that it is given, by sensorClearance() along its normal. One that
 * has no normal is taken towards the middle of the scene, less so near to it: then the outermost
 * points of a grid that fills a room are in the room.
 *
 * Nothing if the sensor is farther than 2^20 sizes of the scene away from it: rounding would tell
 * what it sees. `bounds`: of all surfaces. `near`: boundsBesideLamps().
 */
std::optional<LitPoint> sensorPlace(const Box& bounds, const Box& near, const Sensor& sensor);

/// Of all lights for which cells gather direct light, what asks them for the light that comes
/// straight to sensors; all other light arrives with the photons of walks. The engine must not
/// change meanwhile.
std::deque<PointDirectLight> gatheredLightsOf(const IrradianceEngine& engine);
/// W/m2 of these lights on the surface on which a sensor stands. `number`: of the sensor. May be
/// called by several threads.
Bands directLightAt(const Foot& foot, std::uint64_t number,
  const std::deque<PointDirectLight>& lights, const Scene& scene);

/**
 * What sensors receive, on surfaces or in the air: irradiance, or of a sensor that receives from
 * all directions the fluence rate. The direct light of all lights is asked for at the very point,
 * see PointDirectLight. Indirect light comes by a final gather from there, see ViewFinalGather.
 * Theory.md, 5.8.
 *
 * All is a pure function of the scene, the seed, the sums, and the place and number of a sensor.
 */
class SensorFinalGather
{
public:
  /// Of the present frame of an engine, which must not change meanwhile.
  /// `rays`: to lights and for indirect light each; rounded up to a multiple of the replicates.
  /// `keepsRays`: for update() in frames in which things have moved. Throws Interrupted, and
  /// InputError where a point light shines on specular cells.
  SensorFinalGather(const IrradianceEngine& engine, std::uint32_t rays, Execution& execution,
    bool keepsRays = false);

  /// NaN of a sensor that is too far away, see sensorPlace().
  using Light = ViewedLight;
  /// What each replicate adds to the light of a sensor, or of several together, W/m2; NaN of one
  /// that is too far away.
  using Replicates = std::vector<Bands>;
  static Light lightOf(const Replicates& replicates);

  /// The rays of some sensors, which are kept for frames in which things have moved.
  struct Rays
  {
    struct Start
    {
      std::optional<LitPoint> place; ///< none: the sensor is too far away
      bool isInside = false; ///< in the bounds of the scene: there paths start at the very place
      bool isKept = false;   ///< its rays are those of before, but for what moved
      std::vector<std::vector<ShadowRay>> shadows = {}; ///< by group of lights
      std::vector<Bands> direct = {}; ///< W/m2 that come straight from the lights, by replicate
    };
    std::vector<Start> starts;
    FollowedPaths paths; ///< those of each start that has a place

    /// Of its memory.
    std::size_t bytes() const;
  };
  /// At the sensors of these numbers, which choose the samples. Cast are only rays that may have
  /// changed since those that are given, and those of sensors that were elsewhere. `numbers`: the
  /// same as then, or from the first on fewer or more. `motion`: since then; null: all are cast.
  /// Adds to `cast` how many that were, paths and rays to lights together. Throws
  /// std::runtime_error for a path that does not end. May be called by several threads.
  std::vector<Replicates> update(const std::vector<Sensor>& sensors,
    const std::vector<std::size_t>& numbers, const FinalGatherMotion* motion, Rays& rays,
    std::int64_t& cast) const;
  const FinalGatherScene& scene() const { return gather_.scene(); }

private:
  /// With what is kept of before, which is taken away.
  std::vector<Rays::Start> startsOf(const std::vector<Sensor>& sensors,
    const std::vector<std::size_t>& numbers, const FinalGatherMotion* motion,
    std::vector<Rays::Start>& before) const;
  /// Those of before, but for those that are followed anew.
  FollowedPaths pathsOf(const std::vector<Rays::Start>& starts,
    const std::vector<std::size_t>& numbers, const FinalGatherMotion* motion, const Rays& before,
    std::int64_t& cast) const;
  void askLights(Rays::Start& start, std::size_t number, const FinalGatherMotion* motion,
    std::int64_t& cast) const;

  Box near_; ///< see sensorPlace()
  CellShapes noShapes_;
  ViewFinalGather gather_;
  std::deque<PointDirectLight>
    direct_; ///< for the points themselves; each sample is of one replicate
};

}
