// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SensorPlace_h
#define irradiance_SensorPlace_h

#include "Lights/LitPoint.h"
#include "Photons/Sensor.h"
#include "Surfaces/SceneObjects.h"

#include <optional>

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

}

#endif
