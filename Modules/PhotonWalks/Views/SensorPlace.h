// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SensorPlace_h
#define irradiance_SensorPlace_h

#include "Gathering/LitPoint.h"
#include "Photons/Sensor.h"

#include <optional>

namespace irradiance
{

/**
 * Where a sensor receives its light. Sensors stand on surfaces, but their coordinates are rounded, perhaps to floats: so
 * each is taken off the place that it is given, by 2^-20 of the largest coordinate of the scene, along its normal. One
 * that has no normal is taken towards the middle of the scene, less so near to it: then the outermost points of a grid
 * that fills a room are in the room.
 *
 * Nothing if the sensor is farther than 2^20 sizes of the scene away from it: rounding would tell what it sees.
 * `bounds`: of all surfaces.
 */
std::optional<LitPoint> sensorPlace(const Box& bounds, const Sensor& sensor);

}

#endif
